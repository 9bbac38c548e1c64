// A page of the documentation that is shown beside the editor: loads itself again when it has become another one.
(() => {
  "use strict";

  const version = `"${document.currentScript.dataset.version}"`;
  const PAUSE_MS = 1000;

  // Who looks for something goes on.
  const isSearchActive = () => Boolean(document.activeElement?.matches("#search") && document.activeElement.value);

  async function poll() {
    try {
      const isOld = !document.hidden && !isSearchActive() && (await fetch(location.pathname, { method: "HEAD" })).headers.get("etag") !== version;
      if (isOld && !isSearchActive()) return location.reload();
    } catch {
      // The editor was ended. What is shown stays.
    }
    setTimeout(poll, PAUSE_MS);
  }

  setTimeout(poll, PAUSE_MS);
})();
