// The page menu.

// Scroll a long menu to the current page.
const menu = document.querySelector(".menu");
const currentEntry = menu?.querySelector("[aria-current]");
if (currentEntry && currentEntry.offsetTop + currentEntry.offsetHeight > menu.clientHeight) menu.scrollTop = currentEntry.offsetTop - menu.clientHeight / 2;

// On wide screens the style sheet shows the menu without opening it if the browser supports ::details-content.
const hasDetailsContent = window.CSS?.supports?.("selector(::details-content)");
if (!hasDetailsContent && matchMedia("(min-width: 801px)").matches) document.querySelector(".menu details").open = true;
