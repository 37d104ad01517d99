// What the page says of the present, until it no longer holds: lines that stay, and one line of status.
import {$, element} from "./dom.js";

const MOST_LINES = 4;
const GOOD_MS = 8000;  // good news goes by itself

// Commands of one group replace each other's news: a drag that works takes away the words about one that was refused.
const GROUPS = {
  motion: ["mode", "theta", "drag", "release", "fix", "push", "gravity", "pause", "step", "speed", "springs", "reset", "snap", "driven"],
  design: ["hinge", "nearest", "paint", "sheet", "made", "undo", "redo", "open"],
  search: ["search", "part", "stop"],
  save: ["save"],
  export: ["export"],
};
const OF_THE_DISK = ["save", "page"];  // no change of the design makes them wrong

/** The group of a command; what is no command is a group of its own. */
export const groupOf = (type) => Object.keys(GROUPS).find((group) => GROUPS[group].includes(type)) ?? type ?? "page";

/** What a person should read: bad news stays until it is closed, or `about` (a command, or a word) is news again. */
export function say(text, {good = false, about = "page"} = {}) {
  const box = $("messages");
  if ([...box.children].some((line) => line.firstChild.textContent === text)) return;
  const line = element("p", {class: good ? "good" : null}, element("span", {}, text));
  line.dataset.about = groupOf(about);
  line.append(element("button", {type: "button", "aria-label": "Close this message", click: () => line.remove()}, "Close"));
  box.append(line);
  while (box.children.length > MOST_LINES) box.firstChild.remove();
  if (good) setTimeout(() => line.remove(), GOOD_MS);
}

/** Takes away what was said about a command, or about a word. */
export function unsay(about) {
  for (const line of [...$("messages").children]) if (line.dataset.about === groupOf(about)) line.remove();
}

let holds = null;

/** @param stillHolds asked whenever the program's state changes; without it the line stays until the design changes */
export function status(text, stillHolds = null) {
  $("status").textContent = text;
  holds = stillHolds;
}

/** Another design: what was said of the one before is no longer true. */
export function forgetDesign() {
  status("");
  for (const line of [...$("messages").children]) if (!OF_THE_DISK.includes(line.dataset.about)) line.remove();
}

/** Another state of the program. @param mode whether it is computed in another way */
export function forgetState(mode) {
  if (mode) unsay("mode");
  if (mode || (holds && !holds())) status("");
}
