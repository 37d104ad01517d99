// Files for printers, CAD and simulators: formats, process, what was written.
import {$, element, show, status, summaryRows} from "./dom.js";

const USUAL = ["stl", "3mf"];  // what most printers take

/** {bed_mm: [x, y]}; {} where none is given, null where the text is no bed. */
export function bedSides(text) {
  if (!text.trim()) return {};
  const sides = text.split(/[,x\u00d7]/).map(Number);
  return sides.length === 2 && sides.every((side) => side > 0 && side < Infinity) ? {bed_mm: sides} : null;
}

export class MakePanel {
  constructor(state) {
    Object.assign(this, {state, connection: state.connection});
    $("export").addEventListener("submit", (event) => event.preventDefault() ?? this.export());
    state.on("hello", () => this.showHello());
    state.on("exported", () => this.showExported());
  }

  showHello() {
    const {formats = [], processes = []} = this.state.hello;
    $("formats").replaceChildren(...formats.map(({name, about}) => element("label", {},
      element("input", {type: "checkbox", name: "format", value: name, checked: USUAL.includes(name)}), element("span", {}, name.toUpperCase()), element("small", {}, about))));
    $("export").elements.process.replaceChildren(element("option", {value: ""}, "as the design says"), ...processes.map((name) => element("option", {value: name}, name)));
  }

  async export() {
    const formats = [...document.querySelectorAll('input[name="format"]:checked')].map(({value}) => value), {process: {value: process}, hinge: {value: hinge}, orient: {value: orient}, clearance_mm: {value: clearance}, bed} = $("export").elements;
    if (!$("export").reportValidity()) return;
    if (!formats.length) return status("choose a format first");
    const sides = bedSides(bed.value);
    if (!sides) return status("the bed is two lengths in mm: 250, 210");
    status("exporting\u2026");
    await this.connection.send("export", {formats, orient, ...(process ? {process} : {}), ...(hinge ? {hinge} : {}), ...(clearance ? {clearance_mm: Number(clearance)} : {}), ...sides}).catch(() => status("nothing was written"));
  }

  showExported() {
    const {folder, files, summary} = this.state.exported;
    show($("written"), true);
    $("written_folder").textContent = folder;
    $("written_files").replaceChildren(...files.map((name) => element("li", {}, name)));
    $("written_text").replaceChildren(...summaryRows(summary ?? ""));
    status(`${files.length} files written`);
  }
}
