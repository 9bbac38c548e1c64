// The menu of pages.

// Of a long menu the part with this page is shown.
const menu = document.querySelector(".menu");
const currentEntry = menu?.querySelector("[aria-current]");
if (currentEntry && currentEntry.offsetTop + currentEntry.offsetHeight > menu.clientHeight) menu.scrollTop = currentEntry.offsetTop - menu.clientHeight / 2;

// Wide screens show the menu without opening it, where the style sheet can say so.
const hasDetailsContent = window.CSS?.supports?.("selector(::details-content)");
if (!hasDetailsContent && matchMedia("(min-width: 801px)").matches) document.querySelector(".menu details").open = true;
