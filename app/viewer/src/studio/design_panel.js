// The design in numbers: sheet, hinges, how they are made, and its problems.
import {$, degrees, element, describeFold, neat, show, typed} from "./dom.js";
import {describeTurn} from "./bodies_panel.js";
import {CellMap} from "./cell_map.js";
import {showMessage, status, clearMessage} from "./messages.js";

const FAMILIES = {F1: "stays flat: scales and shears", F2: "bends in one direction", F3: "bends with zigzag rows", F4: "folds as a net", planar: "stays flat", creased: "folds along its creases"};

export class DesignPanel {
  constructor(state) {
    Object.assign(this, {state, connection: state.connection});
    this.map = new CellMap(state, $("map"));
    this.listen();
    state.on("hello", () => this.showHello());
    state.on("design", () => this.showDesign());
    state.on("chosen", () => (clearMessage("choice"), this.showHinge()));
  }

  /** @param words shown when it is done */
  send(type, keys, words = "") {
    return this.connection.send(type, keys).then(() => words && status(words), () => this.showDesign());
  }

  listen() {
    $("sheet").addEventListener("change", ({target}) => target.checkValidity() ? this.send("sheet", {[target.name]: Number(target.value)}) : target.reportValidity());
    $("hinge").addEventListener("change", ({target}) => target.name && this.setHinges(target.name, Number(target.value)));
    for (const id of ["sheet", "hinge", "made"]) $(id).addEventListener("submit", (event) => event.preventDefault());
    $("made").addEventListener("change", () => this.setHingeKind());
    $("nearest").addEventListener("click", () => this.send("nearest", {}, "now it has one degree of freedom"));
    $("pick_none").addEventListener("click", () => this.state.choose([]));
    $("pick_column").addEventListener("click", () => this.widen("column"));
    $("pick_row").addEventListener("click", () => this.widen("row"));
    $("open_file").addEventListener("change", async ({target}) => {
      const [file] = target.files;
      if (file) this.send("open", {yaml: await file.text()});
      target.value = "";
    });
  }

  setHingeKind() {
    const form = $("made"), kind = form.elements.kind.value, material = form.elements.material.value;
    this.send("made", kind === "stiff" ? {kind} : {kind, material});
  }

  /** Chooses all hinges of the chosen one's direction in its column or row. */
  widen(line) {
    const {chosen, design} = this.state, first = chosen.length ? this.state.wall(chosen[0]) : null;
    if (!first) return showMessage("Choose a hinge of a sheet of squares first.", {about: "choice"});
    this.state.choose(design.structure.hinges.map((_, k) => k).filter((k) => {
      const wall = this.state.wall(k);
      return wall.along === first.along && wall[line] === first[line];
    }));
  }

  /** Sets a number of the chosen hinges. Tilts alternate along a crease, and so do the halves of walls. */
  setHinges(name, value) {
    const {chosen: indices, squares} = this.state;
    if (!Number.isFinite(value) || !indices.length) return;
    this.send("hinge", {indices, [name]: value, ...(squares ? {alternate: $("alternate").checked, symmetry: $("symmetry").value} : {})});
  }

  showHello() {
    const {hello} = this.state;
    $("templates").replaceChildren(...(hello.templates ?? []).map(({name, about}) =>
      element("button", {type: "button", title: about, click: () => this.send("open", {template: name})}, name)));
    $("made").elements.material.replaceChildren(...(hello.materials ?? []).map((name) => element("option", {value: name}, name)));
  }

  showDesign() {
    const {design} = this.state, {structure} = design;
    $("name").textContent = design.name;
    document.title = `${design.name} \u2013 KinetiX studio`;
    this.showUnsaved();
    $("undo").disabled = !design.undo;
    $("redo").disabled = !design.redo;
    this.showVerdict();
    if (design.bodies) return;
    this.showSheet(structure);
    this.showHingeKind();
    this.state.chosen = this.state.chosen.filter((index) => index < structure.hinges.length);
    this.showHinge();
  }

  /** Shows whether the design is saved, where it is kept if not, and its fold. */
  showUnsaved() {
    const {unsaved, kept, not_kept, restored, theta_rad, bodies} = this.state.design, {autosave} = this.state.hello ?? {};
    show($("unsaved"), unsaved);
    $("unsaved").textContent = kept ? "not saved" : "not saved, without a copy";
    $("unsaved").title = kept ? `A copy is in ${autosave} until you save. If the studio is killed, the next one opens the copy.` : not_kept ?? "";
    $("design_fold").textContent = bodies ? "" : `design: ${describeFold(theta_rad)}`;
    if (restored) showMessage("These changes were not saved when the studio ended. Undo shows the saved design.", {about: "restored"});
    else clearMessage("restored");
  }

  showVerdict() {
    const {exact, family, why, breaking = [], bodies} = this.state.design;
    $("verdict").className = `verdict ${exact ? "good" : bodies?.following ? "" : "bad"}`;
    $("verdict_text").textContent = bodies ? describeTurn(this.state.design) : exact ? `One degree of freedom: ${FAMILIES[family] ?? family}.` : "Does not move without strain.";
    const reasons = Array.isArray(why) ? why : why ? [why] : [];
    $("why").replaceChildren(...reasons.map((reason) => element("li", {}, reason)),
      ...(breaking.length ? [element("li", {}, `${breaking.length} ${breaking.length === 1 ? "hinge breaks" : "hinges break"} it, marked red`)] : []));
    show($("nearest"), !exact && breaking.length > 0);
  }

  showSheet({cells, cell_mm, wall_mm}) {
    const form = $("sheet").elements, squares = this.state.squares;
    const set = (name, value) => document.activeElement !== form[name] && (form[name].value = typed(value));
    if (squares) for (const [k, name] of ["columns", "rows"].entries()) set(name, 1 + Math.max(...cells.map(({cell}) => cell[k])));
    for (const name of ["columns", "rows", "cell_mm", "thickness_mm", "height_mm"]) form[name].disabled = !squares;
    set("cell_mm", cell_mm);
    set("thickness_mm", wall_mm?.thickness);
    set("height_mm", wall_mm?.height);
    const size = this.state.design.flat_mm?.map((v) => neat(v, 1)).join(" \u00d7 ");
    const {bodies, hinges} = this.state.design.structure;
    $("flat_size").textContent = `${size ? `${size} mm flat, ` : ""}${bodies.length} bodies, ${hinges.length} hinges`;
  }

  showHingeKind() {
    const {kind, material, text} = this.state.design.hinge ?? {}, form = $("made").elements;
    if (kind) form.kind.value = kind;
    if (typeof material === "string" && [...form.material.options].some((option) => option.value === material)) form.material.value = material;
    form.material.disabled = form.kind.value === "stiff";
    $("made_text").textContent = text ?? "";
  }

  showHinge() {
    const {chosen, design} = this.state;
    if (design.bodies) return;
    show($("hinge"), chosen.length > 0);
    if (!chosen.length) return;
    const hinge = design.structure.hinges[chosen[0]], form = $("hinge").elements, wall = this.state.wall(chosen[0]);
    const where = wall ? `, wall along ${wall.along}, column ${wall.column}, row ${wall.row}` : "";
    $("hinge_title").textContent = chosen.length === 1 ? `Hinge ${chosen[0]}${where}` : `${chosen.length} hinges${where && ` from ${where.slice(2)}`}`;
    const values = {t: hinge.t, beta_deg: degrees(hinge.beta_rad), alpha_deg: degrees(hinge.alpha_rad), offset_mm: hinge.offset_mm ?? 0};
    for (const [name, value] of Object.entries(values)) if (document.activeElement !== form[name]) form[name].value = typed(value);
  }
}
