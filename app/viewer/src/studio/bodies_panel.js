// Panel of a design of bodies: its range of motion, its hinges, and data of the chosen body or hinge.
import {$, degrees, element, neat, show, typed} from "./dom.js";
import {status} from "./messages.js";

const MOST_LINES = 8;  // of the list of hinges; longer lists scroll
const KINDS = {block: "soft part", pin: "pin in a bore", hinge: "hinge", ball: "ball, turns every way"};
const vector = (v, digits) => v.map((each) => neat(each, digits)).join(", ");

export class BodiesPanel {
  constructor(state) {
    Object.assign(this, {state, connection: state.connection});
    $("hinge_list").addEventListener("change", () => this.state.chooseHinge(Number($("hinge_list").value)));
    $("turn_this").addEventListener("click", () => this.drive());
    $("stiffness").addEventListener("submit", (event) => event.preventDefault());
    $("stiffness").addEventListener("change", ({target}) => target.checkValidity() ? this.setStiffness(target) : target.reportValidity());
    state.on("design", () => this.showDesign());
    state.on("chosen", () => this.showChosen());
    state.on("body", () => this.showChosen());
  }

  get hinges() {
    return this.state.design.structure.hinges;
  }

  async drive() {
    const [hinge] = this.state.chosen;
    if (hinge === undefined) return status("choose a hinge first");
    const turns = () => this.state.design.bodies?.driven === hinge;
    await this.connection.send("driven", {hinge}).then(() => status(`${this.hinges[hinge].name} is turned`, turns), () => {});
  }

  setStiffness({name, value}) {
    this.connection.send("hinge", {indices: this.state.chosen, [name]: Number(value)}).catch(() => this.showChosen());
  }

  /** Shows a design of bodies. The style sheet hides controls that do not apply to bodies. */
  showDesign() {
    const {bodies, structure} = this.state.design;
    if (bodies) document.documentElement.dataset.thing = "bodies";
    else delete document.documentElement.dataset.thing;
    if (!bodies) return;
    if (!this.opened) this.state.chosen = bodies.pulled ? [] : [bodies.driven];
    this.opened = true;
    for (const option of $("colour").options) option.hidden = option.disabled = !["plain", "turn"].includes(option.value);
    const of = ({bodies: ends}) => ends.map((body) => structure.bodies[body].name).join(" \u2013 ");
    $("hinge_list").replaceChildren(...structure.hinges.map((hinge, k) =>
      element("option", {value: String(k)}, `${hinge.name}${k === bodies.driven && !bodies.pulled ? " (turned)" : ""}: ${of(hinge)}`)));
    $("hinge_list").size = Math.max(2, Math.min(MOST_LINES, structure.hinges.length));
    const size = this.state.design.flat_mm.map((v) => neat(v, 1)).join(" \u00d7 ");
    $("bodies_size").textContent = `${structure.bodies.length} bodies, ${structure.hinges.length} hinges, ${size} mm at rest`;
    this.showChosen();
  }

  showChosen() {
    if (!this.state.design?.bodies) return;
    const {body, chosen: [hinge]} = this.state;
    $("hinge_list").value = hinge === undefined ? "" : String(hinge);
    const {driven, pulled} = this.state.design.bodies;
    $("turn_this").disabled = hinge === undefined || (hinge === driven && !pulled) || this.hinges[hinge].kind === "ball";
    show($("chosen_thing"), hinge !== undefined || body !== null);
    show($("stiffness"), hinge !== undefined && this.hinges[hinge].kind !== "ball");
    if (hinge !== undefined) this.showHinge(this.hinges[hinge]);
    else if (body !== null) this.showBody(body);
  }

  showRows(title, rows) {
    $("chosen_title").textContent = title;
    $("chosen_rows").replaceChildren(...rows.map(([name, value]) => element("div", {}, element("dt", {}, name), element("dd", {}, value))));
  }

  showHinge({name, kind, bodies, axis, point_mm, reach_mm, k, confidence, diameter_mm, clearance_mm}) {
    const {structure} = this.state.design;
    this.showRows(name, [
      ["kind", KINDS[kind] ?? kind],
      ["joins", bodies.flatMap((body, n) => [n ? " and " : "", this.link(structure.bodies[body].name, () => this.state.chooseBody(body))])],
      ["axis", vector(axis, 4)],
      ["through", `${vector(point_mm, 3)} mm`],
      ...(diameter_mm ? [["rod", `${neat(diameter_mm, 3)} mm, clearance ${neat(clearance_mm, 3)} mm`]] : []),
      ["sure", `${neat(100 * confidence, 0)} % of its axis`],
    ]);
    for (const [key, value] of Object.entries({...k, reach_mm})) {
      const field = $("stiffness").elements[key];
      if (field && document.activeElement !== field) field.value = typed(value, 6);
    }
  }

  showBody(body) {
    const {structure} = this.state.design, at = this.hinges.flatMap(({bodies}, k) => (bodies.includes(body) ? [k] : []));
    this.showRows(structure.bodies[body].name, [
      ["kind", "rigid body"],
      ["center", `${vector(structure.bodies[body].position_mm, 3)} mm at rest`],
      ["hinges", at.flatMap((hinge, n) => [n ? ", " : "", this.link(this.hinges[hinge].name, () => this.state.chooseHinge(hinge))])],
    ]);
  }

  link(text, click) {
    return element("button", {type: "button", class: "link", click}, text);
  }
}

/** Describes the direction and range of the motion in a sentence for the heading of the panel. */
export function describeTurn({bodies, exact, structure}) {
  const {name} = structure.hinges[bodies.driven];
  if (bodies.pulled) return bodies.following ? "Following the pull\u2026" : `Bodies are pulled: hinges turn by ${neat(degrees(bodies.turn_range_rad[1]), 0)}\u00b0 on average.`;
  if (bodies.following) return `Following ${name}\u2026`;
  if (!exact) return `${name} does not turn.`;
  const met = bodies.meets?.some((meeting) => meeting), ends = bodies.turn_range_rad.map((turn, k) => bodies.meets?.[k]?.turn_rad ?? turn);
  const [least, most] = ends.map((turn) => neat(degrees(turn), 0));
  return `${name} turns from ${least}\u00b0 to ${most}\u00b0${met ? " until bodies collide" : ""}.`;
}
