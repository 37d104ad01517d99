// Files for printers, CAD and simulators: formats, process, and the list of written files.
import {$, element, describeFold, show, summaryRows} from "./dom.js";
import {status} from "./messages.js";

const USUAL = ["stl", "3mf"];  // accepted by most printers
const MESHES = ["stl", "3mf", "glb"];  // formats for bodies

/** Reads {bed_mm: [x, y]}; {} for an empty text, null if the text is not a bed. */
export function bedSides(text) {
  if (!text.trim()) return {};
  const sides = text.split(/[,x\u00d7]/).map(Number);
  return sides.length === 2 && sides.every((side) => side > 0 && side < Infinity) ? {bed_mm: sides} : null;
}

/** Makes the folding card: pictures with arrows, and what to do. */
function cardContent({pictures, steps}) {
  const source = (text) => `data:image/svg+xml,${encodeURIComponent(text)}`;
  return [
    element("h2", {}, "How to fold it"),
    ...pictures.map(({svg, caption}) => element("figure", {}, element("img", {src: source(svg), alt: caption}), element("figcaption", {}, caption))),
    element("ol", {}, ...steps.map(([title, how]) => element("li", {}, element("strong", {}, `${title}. `), how))),
  ];
}

export class MakePanel {
  constructor(state) {
    Object.assign(this, {state, connection: state.connection});
    $("export").addEventListener("submit", (event) => event.preventDefault() ?? this.export());
    state.on("hello", () => this.showHello());
    state.on("exported", () => this.showExported());
    $("export").elements.folded.addEventListener("change", () => this.showFold());
    for (const what of ["design", "frame", "result"]) state.on(what, () => this.showFold());
    state.on("design", () => this.showWhose());
  }

  showHello() {
    const {formats = [], processes = []} = this.state.hello;
    $("formats").replaceChildren(...formats.map(({name, about}) => element("label", {class: MESHES.includes(name) ? null : "of_sheets"},
      element("input", {type: "checkbox", name: "format", value: name, checked: USUAL.includes(name)}), element("span", {}, name.toUpperCase()), element("small", {}, about))));
    $("export").elements.process.replaceChildren(element("option", {value: ""}, "as in the design"), ...processes.map((name) => element("option", {value: name}, name)));
  }

  /** Describes the fold of a sheet, or the turn of the hinge of bodies. */
  angle(theta) {
    return describeFold(theta * (this.state.design.bodies?.turn_per_theta ?? 1));
  }

  /** Shows the fold for the export: the design's, or the shown one. */
  showFold() {
    const {design, frame} = this.state, {folded} = $("export").elements;
    if (!design) return;
    const [asDesign, asShown] = [this.angle(design.theta_rad), frame ? this.angle(frame.theta) : "\u2013"];
    const words = [`${design.has_result ? "as found" : "as in the design"} (${asDesign})`, `as shown (${asShown})`];
    words.forEach((text, k) => folded.options[k].textContent !== text && (folded.options[k].textContent = text));
  }

  /** Marks written files that belong to another design after a change of the design. */
  showWhose() {
    const {exported, design} = this.state;
    if (exported) $("written_title").textContent = exported.revision === design.revision ? "Written" : "Written, of another design than that shown";
  }

  async export() {
    const formats = [...document.querySelectorAll('input[name="format"]:checked')].map(({value}) => value), {process: {value: process}, hinge: {value: hinge}, orient: {value: orient}, clearance_mm: {value: clearance}, folded: {value: folded}, bed} = $("export").elements;
    if (!$("export").reportValidity()) return;
    if (!formats.length) return status("choose a format first");
    const sides = bedSides(bed.value);
    if (!sides) return status("the bed is two lengths in mm: 250, 210");
    status("exporting\u2026");
    await this.connection.send("export", {formats, orient, ...(process ? {process} : {}), ...(hinge ? {hinge} : {}), ...(clearance ? {clearance_mm: Number(clearance)} : {}), ...(folded === "shown" ? {at_fold: true} : {}), ...sides}).catch(() => status("nothing was written"));
  }

  showExported() {
    const {folder, files, summary, card, theta_rad, at_fold} = this.state.exported;
    show($("written"), true);
    this.showWhose();
    $("written_fold").textContent = `Folded ${at_fold ? "as it was shown" : "as in its design"}: ${this.angle(theta_rad)}.`;
    $("written_folder").textContent = folder;
    $("written_files").replaceChildren(...files.map((name) => element("li", {}, name)));
    $("written_text").replaceChildren(...summaryRows(summary ?? ""));
    $("written_card").replaceChildren(...(card ? cardContent(card) : []));
    status(`${files.length} files written`);
  }
}
