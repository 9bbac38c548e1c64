// In other documentation, the script shows its page in a frame, which tells its height.
const script = document.currentScript;
if ("vicodeTry" in script.dataset) {
  const frame = document.createElement("iframe");
  frame.src = new URL(`${page}#try-only`, script.src).href;
  frame.title = `${title}: try it`;
  Object.assign(frame.style, { display: "block", width: "100%", height: "720px", border: "0" });
  addEventListener("message", (event) => {
    const height = Number(event.data?.vicodeTryHeight);
    if (event.source === frame.contentWindow && height > 0) frame.style.height = `${Math.min(height, 4000)}px`;
  });
  script.after(frame);
  return;
}
