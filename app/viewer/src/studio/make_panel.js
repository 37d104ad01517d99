// Files for printers, CAD and simulators: formats, process, what was written.
import {$, element, show, status} from "./dom.js";

const USUAL = ["stl", "3mf"];  // what most printers take

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
    const formats = [...document.querySelectorAll('input[name="format"]:checked')].map(({value}) => value), {process: {value: process}, clearance_mm: {value: clearance}} = $("export").elements;
    if (!formats.length) return status("choose a format first");
    status("exporting\u2026");
    await this.connection.send("export", {formats, ...(process ? {process} : {}), ...(clearance ? {clearance_mm: Number(clearance)} : {})}).catch(() => status("nothing was written"));
  }

  showExported() {
    const {folder, files, summary} = this.state.exported;
    show($("written"), true);
    $("written_folder").textContent = folder;
    $("written_files").replaceChildren(...files.map((name) => element("li", {}, name)));
    $("written_text").textContent = summary ?? "";
    status(`${files.length} files written`);
  }
}
