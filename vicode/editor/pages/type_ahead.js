// Keeps what is typed between a gesture and the focus of the field that it opens, and puts it into the field.
{
  const WAIT_MS = 3000;
  let text = null;
  let untilMs = 0;
  const isField = (element) => element.matches("input:not([type=checkbox]), textarea, [contenteditable=true]");
  const stop = () => (text = null);
  /** Called by a gesture for which the server opens a field. */
  window.awaitField = () => {
    text = "";
    untilMs = performance.now() + WAIT_MS;
  };
  window.addEventListener(
    "keydown",
    (event) => {
      if (text === null) return;
      const isCommand = event.ctrlKey || event.metaKey || event.altKey || event.key === "Escape";
      if (isCommand || performance.now() > untilMs) return stop();
      if (event.key.length === 1) text += event.key;
      else if (event.key === "Backspace") text = text.slice(0, -1);
      else if (event.key !== "Enter") return;
      event.preventDefault();
      event.stopImmediatePropagation();
    },
    true,
  );
  document.addEventListener("pointerdown", stop, true);
  document.addEventListener("focusin", ({ target }) => {
    if (text === null || !isField(target)) return;
    const typed = text;
    stop();
    // An editing command, so that every kind of field takes the text as typed.
    if (typed) setTimeout(() => document.execCommand("insertText", false, typed));
  });
}
