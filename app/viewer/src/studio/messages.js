// Messages of the page, which disappear when they no longer apply: lines that stay, and one status line.
import {$, element} from "./dom.js";

const MOST_LINES = 4;
const GOOD_MS = 8000;  // good news disappears after this time

// Commands of one group replace each other's messages: a successful drag removes the message of a refused one.
const GROUPS = {
  motion: ["mode", "theta", "drag", "release", "fix", "push", "gravity", "pause", "step", "speed", "springs", "reset", "snap", "driven"],
  design: ["hinge", "nearest", "paint", "sheet", "made", "undo", "redo", "open"],
  search: ["search", "part", "stop"],
  save: ["save"],
  export: ["export"],
};
const OF_THE_DISK = ["save", "page"];  // stay valid after a change of the design

/** Returns the group of a command; any other word is a separate group. */
export const groupOf = (type) => Object.keys(GROUPS).find((group) => GROUPS[group].includes(type)) ?? type ?? "page";

/** Shows a message. Bad news stays until it is closed, or there is news about `about` (a command or another word). */
export function showMessage(text, {good = false, about = "page"} = {}) {
  const box = $("messages");
  if ([...box.children].some((line) => line.firstChild.textContent === text)) return;
  const line = element("p", {class: good ? "good" : null}, element("span", {}, text));
  line.dataset.about = groupOf(about);
  line.append(element("button", {type: "button", "aria-label": "Close this message", click: () => line.remove()}, "Close"));
  box.append(line);
  while (box.children.length > MOST_LINES) box.firstChild.remove();
  if (good) setTimeout(() => line.remove(), GOOD_MS);
}

/** Removes the messages about a command or another word. */
export function clearMessage(about) {
  for (const line of [...$("messages").children]) if (line.dataset.about === groupOf(about)) line.remove();
}

let holds = null;

/** @param stillHolds called after changes of the program's state; without it the line stays until the design changes */
export function status(text, stillHolds = null) {
  $("status").textContent = text;
  holds = stillHolds;
}

/** Removes messages that a change of the design makes invalid. */
export function forgetDesign() {
  status("");
  for (const line of [...$("messages").children]) if (!OF_THE_DISK.includes(line.dataset.about)) line.remove();
}

/** Removes messages that a new state of the program makes invalid. @param mode whether the mode changed */
export function forgetState(mode) {
  if (mode) clearMessage("mode");
  if (mode || (holds && !holds())) status("");
}
