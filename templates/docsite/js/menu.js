// The menu of pages.

// Of a long menu the part with this page is shown.
const menu = document.querySelector(".menu");
const here = menu?.querySelector("[aria-current]");
if (here && here.offsetTop + here.offsetHeight > menu.clientHeight) menu.scrollTop = here.offsetTop - menu.clientHeight / 2;

// Wide screens show the menu without opening it, where the style sheet can say so.
const showsClosed = window.CSS?.supports?.("selector(::details-content)");
if (!showsClosed && matchMedia("(min-width: 801px)").matches) document.querySelector(".menu details").open = true;
