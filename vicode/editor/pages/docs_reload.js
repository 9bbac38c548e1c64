// Reloads a documentation page served by the editor when it has changed.
(() => {
  "use strict";

  const version = `"${document.currentScript.dataset.version}"`;
  const PAUSE_MS = 1000;

  // Do not interrupt a search.
  const isSearchActive = () => Boolean(document.activeElement?.matches("#search") && document.activeElement.value);

  async function poll() {
    try {
      const isOld = !document.hidden && !isSearchActive() && (await fetch(location.pathname, { method: "HEAD" })).headers.get("etag") !== version;
      if (isOld && !isSearchActive()) return location.reload();
    } catch {
      // The editor was stopped. Keep the page.
    }
    setTimeout(poll, PAUSE_MS);
  }

  setTimeout(poll, PAUSE_MS);
})();
