// The texts that the canvas shows or that screen readers speak. Labels of commands come from Python's table.

export const EMPTY = "No states yet.\nDouble-click, or press S, to add the first one.\nOr press Ctrl+K and type a line: Idle -order-> Drive -20 s-> Idle";

export const STAGE_ROLE = "state machine canvas";
export const DIAGRAM = "Diagram";
export const LAYERS = { frames: "Frames", links: "Links to components", edges: "Transitions", nodes: "States and components" };
export const stageName = (component) => `State machine ${component}`;

// Clipboard
export const COPIED = "Copied";
export const CUT = "Cut";
export const COPY_FAILED = "Nothing was copied. Check that the browser allows clipboard access.";
export const COPY_TIMED_OUT = "Nothing was copied: the server does not answer.";
export const PASTE_BY_KEY = "Press Ctrl+V to paste";
export const CLIPBOARD_EMPTY = "The clipboard contains no text";
export const CLIPBOARD_TOO_LARGE = "The text on the clipboard is too large";

// Gestures
export const CONNECT = "Connect to";
export const CHANGE_TARGET = "Change target to";
export const CHANGE_SOURCE = "Change source to";
export const chooseTarget = (action) => `${action}…: click a node or type its name. Esc cancels.`;
export const confirmTarget = (action, name) => `${action} ${name}: press Enter. Esc cancels.`;
export const DRAW_FRAME = "Draw a rectangle around the states of the frame. Esc cancels.";
export const DROP_ON_LABEL = "Drop on another label of this state to change the priority";

// Controls
export const FOLD = "Hide inside (E)";
export const OPEN_DESIGN = "Open design";
export const INSIDE_EDIT = "Edits change this file. F2: rename or edit guard, S: new state, T: add transition, Del: delete, I: initial, F: final, D: disable";
export const insetEditName = (component) => `Edit ${component}`;
export const insetName = (alias, component) => `Inside ${alias}: state machine ${component}`;
export const MENU = "Menu";
export const NAME = "Name";
export const GUARD = "Guard";
export const GUARD_HINT = "guard, or 20 s";
export const VIEW = "View";
export const SELECT_SEVERAL = "Select several";
export const ZOOM_IN = "Zoom in (+)";
export const ZOOM_OUT = "Zoom out (-)";
export const ZOOM_TO_FIT = "Zoom to fit (1)";
export const ZOOM_TO_100 = "Zoom to 100% (0)";

export const namesOnly = (percent) => `The whole diagram at ${percent}%: names only. Zoom in to read guards.`;

export const goTo = (name) => `Go to ${name}`;
export const SHOW_ALL = "Show all (Esc)";
export const neighborhoodName = (name, steps, shown, all) => `Within ${steps === 1 ? "1 transition" : `${steps} transitions`} of ${name}: ${shown} of ${all} nodes`;

// Descriptions of elements
export const MARKS = { selected: "selected", active: "active", taken: "last transition taken", breakpoint: "breakpoint", "heat-never": "never in the trace" };
// The colors of the heat map.
export const HEAT = ["blue", "yellow", "orange", "red", "never"];
export const CHANGED_OUTSIDE = "code changed outside";
export const DISABLED = "disabled";
export const EVERY_STATE = "every state";
export const COMMON_TITLE = "Common transitions, tested before the transitions of each state";
export const commonName = (count) => `Common transitions of every state: ${count}`;
export const componentName = (alias) => `Component ${alias}`;
export const stateName = (name) => `State ${name}`;
export const alias = (name) => `as ${name}`;
export const colored = (color) => `colored ${color}`;
export const FRAME = "Frame";
export const frameName = (title, states) => `${FRAME} ${title}: ${states.join(", ")}`;
export const noteName = (text) => `Note: ${text}`;
export const markName = (name, count) => (count ? `${name} ${count}` : `${name} code`);
export const linkName = ({ kind, state, component }) => `${state} ${kind} ${component}`;
export const transitionName = ({ order, of }, source, target) => `Transition ${order} of ${of} from ${source} to ${target}`;
export const transitionTitle = ({ order, of, leads_back: leadsBack }, source, target) => `${source} ${leadsBack ? "↔" : "→"} ${target}${of > 1 ? ` (${order} of ${of})` : ""}`;
