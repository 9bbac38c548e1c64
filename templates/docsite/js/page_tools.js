// Links of headings and buttons that copy code.
for (const heading of document.querySelectorAll("main :is(h2, h3)[id]")) {
  if (heading.querySelector("a")) continue;
  const anchor = makeElement("a", { href: `#${heading.id}`, className: "anchor" });
  anchor.setAttribute("aria-label", `Link to ${heading.textContent.trim()}`);
  heading.append(" ", anchor);
}

// The clipboard is not available to all pages that are opened from files.
async function copyText(text) {
  if (navigator.clipboard) {
    try {
      await navigator.clipboard.writeText(text);
      return;
    } catch { /* The older way below asks for no permission. */ }
  }
  const area = makeElement("textarea", { value: text, className: "visually-hidden" });
  document.body.append(area);
  area.select();
  document.execCommand("copy");
  area.remove();
}

function copyButton(getText) {
  const button = makeElement("button", { type: "button", className: "copy" }, "Copy");
  button.addEventListener("click", async () => {
    await copyText(getText());
    button.focus();
    button.textContent = "Copied";
    setTimeout(() => { button.textContent = "Copy"; }, 1500);
  });
  return button;
}

for (const figure of document.querySelectorAll("figure.code")) {
  figure.querySelector("figcaption").append(copyButton(() => figure.querySelector("code").textContent));
}
for (const block of document.querySelectorAll(".doc pre")) {
  const frame = makeElement("div", { className: "copy-frame" });
  block.replaceWith(frame);
  frame.append(copyButton(() => block.textContent), block);
}
for (const listing of document.querySelectorAll(".listing")) {
  const lines = () => [...listing.querySelectorAll("code")].map((line) => `${line.textContent}\n`).join("");
  listing.previousElementSibling.append(copyButton(lines));
}
