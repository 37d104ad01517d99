// Panel of the goal: its kind, numbers and file; the search and its verdict.
import {$, element, neat, show, summaryRows} from "./dom.js";
import {DrawingPad} from "./drawing_pad.js";
import {CARDS} from "./goals.js";
import {showMessage, status, clearMessage} from "./messages.js";

const LARGEST_FILE = 32 * 2 ** 20;  // bytes of all files of a search: limit of the program (app/studio/session/uploads.hpp)
const PART = 480e3;                 // bytes, a multiple of 3: the program accepts messages up to 768 KiB, and base64 adds a third

export class GoalPanel {
  constructor(state) {
    Object.assign(this, {state, connection: state.connection, files: {}});
    $("kinds").append(...Object.entries(CARDS).map(([name, {title}], k) => element("label", {},
      element("input", {type: "radio", name: "kind", value: name, checked: k === 0, change: () => this.choose(name)}), element("span", {}, title))));
    this.listen();
    this.choose("bracelet");
    state.on("program", () => this.showProgram());
    state.on("progress", () => this.showProgress());
    state.on("result", () => this.showResult());
    state.on("design", () => this.showWhose());
    this.connection.on("error", ({about}) => about === "search" && this.restore());
  }

  listen() {
    $("goal").addEventListener("input", () => this.compose());
    $("goal").addEventListener("submit", (event) => event.preventDefault());
    $("search").addEventListener("click", () => this.search());
    $("stop").addEventListener("click", () => this.connection.send("stop").catch(() => {}));
  }

  choose(name) {
    this.kind = CARDS[name];
    this.file = this.pad = this.drop = null;
    this.files = {};
    $("goal").replaceChildren(...[this.kind.about && element("p", {class: "note"}, this.kind.about), this.kind.pad && this.padOf(), this.kind.drop && this.dropOf(),
      ...this.kind.fields.map((field) => this.fieldOf(field))].filter(Boolean));
    this.pad?.paint();
    this.compose();
    show($("found"), Boolean(this.state.result) && this.foundKind === this.kind);
  }

  padOf() {
    const canvas = element("canvas", {class: "pad", tabindex: 0, role: "application", "aria-label":
        "Field to draw in. Arrow keys move a mark, Enter sets a point, Backspace takes the last one away."});
    this.pad = new DrawingPad(canvas, this.kind.fields[0].value, () => this.drawn(), this.kind.closed);
    return canvas;
  }

  drawn() {
    this.file = null;
    this.files = {};
    this.drop?.forget();
    this.compose();
  }

  dropOf() {
    const input = element("input", {type: "file", accept: this.kind.drop, "aria-label": `Choose a file (${this.kind.drop})`, change: () => this.take(input.files[0])});
    const words = `${this.kind.pad ? "or drop" : "Drop"} a file here (${this.kind.drop.replaceAll(",", ", ")})`, label = element("span", {class: "note"}, words);
    const over = (on) => (event) => event.preventDefault() ?? box.classList.toggle("over", on);
    const box = element("div", {class: "drop", dragover: over(true), dragleave: over(false),
      drop: (event) => (over(false)(event), this.take(event.dataTransfer.files[0]))}, label, input);
    this.drop = {label, forget: () => ((label.textContent = words), (input.value = ""))};
    return box;
  }

  async take(file) {
    if (!file) return;
    if (file.size > LARGEST_FILE) return showMessage(`${file.name} is larger than ${LARGEST_FILE / 2 ** 20} MiB: name it in a target file and start the studio with that.`, {about: "goal"});
    const bytes = new Uint8Array(await file.arrayBuffer()), name = file.name.replace(/[^\w.-]/g, "_");
    this.file = {name, content: this.kind === CARDS.file ? new TextDecoder().decode(bytes) : undefined};
    this.files = this.kind === CARDS.file ? {} : {[name]: bytes};
    this.pad?.empty();
    this.drop.label.textContent = `${file.name}, ${neat(file.size / 1000, 1)} kB`;
    this.compose();
  }

  fieldOf({name, text, value, unit, kind = "number", choices, ...limits}) {
    if (kind === "select") return element("label", {class: "row"}, text, element("select", {name}, choices.map(([key, words]) => element("option", {value: key}, words))));
    const input = element("input", {name, type: kind, ...limits, ...(kind === "checkbox" ? {} : {value}), ...(kind === "text" ? {maxlength: 12, size: 8} : {})});
    return element("label", {class: "row"}, text, kind === "number" ? element("span", {class: "unit"}, input, unit) : input);
  }

  values() {
    const values = {};
    for (const field of this.kind.fields) {
      const input = $("goal").elements[field.name];
      values[field.name] = field.kind === "checkbox" ? input.checked : field.kind ? input.value : Number(input.value);
    }
    if (this.pad && values.width_mm > 0) this.pad.width_mm = values.width_mm;
    if (this.pad && this.pad.line.length > 2) values.points = this.pad.points;
    return {...values, ...this.file};
  }

  /** Describes the missing input, or returns null. */
  missing(values) {
    if (!$("goal").checkValidity()) return "A number is out of its range.";
    if (this.kind.needsFile && !this.file) return "Choose a file first.";
    if (this.kind.pad && !values.points && !this.file) return "Draw a line first, or choose a file.";
    return null;
  }

  compose() {
    clearMessage("goal");
    const values = this.values(), missing = this.missing(values);
    $("target_text").value = missing ? "" : this.kind.text(values);
    $("search").disabled = Boolean(this.state.program.searching);
    return missing;
  }

  async search() {
    const typed = $("target_text").value, missing = typed.trim() ? null : this.compose();
    if (missing) return $("goal").reportValidity() && showMessage(missing, {about: "goal"});
    show($("found"), false);
    this.state.remember();
    const target = $("target_text").value;
    try {
      for (const [name, bytes] of Object.entries(this.files)) await this.sendParts(name, bytes);
      await this.connection.send("search", {target});
    } catch {
      // The error is on the screen already.
    }
  }

  async sendParts(name, bytes) {
    for (let at = 0; at === 0 || at < bytes.length; at += PART) {
      if (bytes.length > PART) status(`${name}: ${neat((100 * at) / bytes.length, 0)} % sent`);
      await this.connection.send("part", {name, at, content: base64(bytes.subarray(at, at + PART))});
    }
  }

  /** Shows the verdict of the present design again after a search without a result. */
  restore() {
    show($("found"), Boolean(this.state.result));
    this.showWhose();
  }

  showProgram() {
    const {searching} = this.state.program;
    $("search").disabled = Boolean(searching);
    show($("stop"), searching);
    show($("progress"), searching);
    if (searching && !this.wasSearching) $("progress_text").textContent = "searching\u2026";
    if (searching && !this.wasSearching) $("progress_bar").removeAttribute("value");
    this.wasSearching = searching;
  }

  showProgress() {
    const {text, done, left_s, job} = this.state.progress;
    if (job !== "search") return status(text);
    if (done === null) $("progress_bar").removeAttribute("value");
    else $("progress_bar").value = done;
    $("progress_text").textContent = text + (left_s > 1 ? `, about ${Math.ceil(left_s)} s left` : "");
  }

  /** Returns the console's title without the name of the design. */
  get title() {
    const {met, stopped, earlier, result: {name, summary}} = this.state.result, title = summary?.title ?? "computed";
    const short = title.startsWith(`${name}: `) ? title.slice(name.length + 2) : title;
    return `${earlier ? "result of an earlier search: " : stopped && !met ? "stopped, best result so far: " : ""}${short}`;
  }

  /** Marks the verdict as belonging to another design after a change of the design. */
  showWhose() {
    if (!this.state.result || this.state.design.has_result) return;
    $("found_title").textContent = `Result of an earlier version: ${this.title}`;
    $("found_title").className = "";
  }

  showResult() {
    const {met, summary, details, result} = this.state.result, {title} = this, isGood = met && !Object.values(result.verdict ?? {}).includes(false);
    this.foundKind = this.kind;
    show($("found"), true);
    $("found_title").textContent = title.charAt(0).toUpperCase() + title.slice(1);
    $("found_title").className = isGood ? "good" : "bad";
    $("found_text").replaceChildren(...summaryRows(summary ?? "").slice(1),
      ...(details ? [element("details", {}, element("summary", {}, "Details"), ...summaryRows(details))] : []));
    status($("found_title").textContent);
  }
}

function base64(bytes) {
  let text = "";
  for (let k = 0; k < bytes.length; k += 8192) text += String.fromCharCode(...bytes.subarray(k, k + 8192));
  return btoa(text);
}
