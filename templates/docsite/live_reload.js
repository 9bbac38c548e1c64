/* vicode docs: reloads a page when it changes and shows build errors. Only served by `vicode docs --watch`. */
(() => {
  "use strict";

  const build = document.currentScript.dataset.build;
  const path = decodeURIComponent(location.pathname).replace(/\/$/, "/index.html").slice(1);
  const folder = path.slice(0, path.lastIndexOf("/") + 1);
  let source = null;

  function affectsThisPage(file) {
    if (file === "*" || file === path) return true;
    if (file === `${folder}search.js`) return "vicodeSearchIndex" in window;
    return ["site.css", ...[...document.scripts].map((script) => script.getAttribute("src"))].some((name) => file === folder + name);
  }

  function showErrors(errors) {
    document.querySelector(".build-errors")?.remove();
    if (!errors) return;
    const box = document.createElement("section");
    box.className = "build-errors";
    box.setAttribute("role", "alert");
    const title = document.createElement("h2");
    title.textContent = "Build failed";
    const text = document.createElement("pre");
    text.tabIndex = 0;
    text.textContent = errors;
    box.append(title, text);
    document.body.append(box);
  }

  function onMessage(event) {
    const news = JSON.parse(event.data);
    if (news.changed.some(affectsThisPage)) reload();
    else showErrors(news.errors);
  }

  // Wait until the user leaves the search field.
  function reload() {
    const field = document.activeElement;
    if (field?.matches("#search") && field.value) field.addEventListener("blur", () => location.reload(), { once: true });
    else location.reload();
  }

  // Browsers limit the connections per server, so hidden pages disconnect.
  function updateConnection() {
    if (document.hidden) {
      source?.close();
      source = null;
    } else if (!source) {
      source = new EventSource(`/-/events?since=${build}`);
      source.addEventListener("message", onMessage);
    }
  }

  document.addEventListener("visibilitychange", updateConnection);
  addEventListener("pagehide", () => source?.close());
  updateConnection();
})();
