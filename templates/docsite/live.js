/* vicode docs: reloads a page when it has changed, and shows what stands in the way. Only served while a site is watched. */
(() => {
  "use strict";

  const build = document.currentScript.dataset.build;
  const path = decodeURIComponent(location.pathname).replace(/\/$/, "/index.html").slice(1);
  const folder = path.slice(0, path.lastIndexOf("/") + 1);
  let source = null;

  function concerns(file) {
    if (file === "*" || file === path) return true;
    if (file === `${folder}search.js`) return "vicodeIndex" in window;
    return file === `${folder}site.css` || file === `${folder}site.js`;
  }

  function show(errors) {
    document.querySelector(".live-errors")?.remove();
    if (!errors) return;
    const box = document.createElement("section");
    box.className = "live-errors";
    box.setAttribute("role", "alert");
    const title = document.createElement("h2");
    title.textContent = "The latest change cannot be shown";
    const text = document.createElement("pre");
    text.tabIndex = 0;
    text.textContent = errors;
    box.append(title, text);
    document.body.append(box);
  }

  function hear(event) {
    const news = JSON.parse(event.data);
    if (news.changed.some(concerns)) reload();
    else show(news.errors);
  }

  // Who looks for something goes on first.
  function reload() {
    const field = document.activeElement;
    if (field?.matches("#search") && field.value) field.addEventListener("blur", () => location.reload(), { once: true });
    else location.reload();
  }

  // A browser has few connections to one server: pages that nobody sees leave them to the others.
  function listen() {
    if (document.hidden) {
      source?.close();
      source = null;
    } else if (!source) {
      source = new EventSource(`/-/news?since=${build}`);
      source.addEventListener("message", hear);
    }
  }

  document.addEventListener("visibilitychange", listen);
  addEventListener("pagehide", () => source?.close());
  listen();
})();
