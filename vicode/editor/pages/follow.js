// A page of the documentation that is shown beside the editor: loads itself again when it has become another one.
(() => {
  "use strict";

  const mark = `"${document.currentScript.dataset.mark}"`;
  const PAUSE_MS = 1000;

  // Who looks for something goes on.
  const isSearched = () => Boolean(document.activeElement?.matches("#search") && document.activeElement.value);

  async function look() {
    try {
      const isOld = !document.hidden && !isSearched() && (await fetch(location.pathname, { method: "HEAD" })).headers.get("etag") !== mark;
      if (isOld && !isSearched()) return location.reload();
    } catch {
      // The editor was ended. What is shown stays.
    }
    setTimeout(look, PAUSE_MS);
  }

  setTimeout(look, PAUSE_MS);
})();
