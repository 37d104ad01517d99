// Main script of the studio's page.
import {exactMotion} from "../fold.js";
import {canRecord, listenForFilm, saveAs} from "../recording.js";
import {Scene} from "../scene.js";
import {decoded} from "../solids.js";
import {BodiesPanel} from "./bodies_panel.js";
import {Connection} from "./connection.js";
import {DesignPanel} from "./design_panel.js";
import {$, degrees, describeFold, neat, radians, show} from "./dom.js";
import {GoalPanel} from "./goal_panel.js";
import {distancesOf, ghostOf, goalOf, placementOf} from "./goals.js";
import {DragTool} from "./drag_tool.js";
import {MakePanel} from "./make_panel.js";
import {MotionBar} from "./motion_bar.js";
import {PageState} from "./page_state.js";
import {PathChart} from "./path_chart.js";
import {turnBetween} from "../quaternion.js";
import {tabs} from "./tabs.js";
import {forgetDesign, forgetState, showMessage, status, clearMessage} from "./messages.js";

const STAND_THETA = radians(20);  // least fold from which the orientation of an exact sheet is computed

const connection = new Connection(location.hash.slice(1)), state = new PageState(connection);
let dragTool = null;
const scene = new Scene($("scene"), {isTaken: (event) => dragTool?.takes(event) ?? false});
dragTool = new DragTool(state, scene);
const bar = new MotionBar(state);
new DesignPanel(state);
new BodiesPanel(state);
new GoalPanel(state);
new MakePanel(state);
new PathChart(state);
tabs(document.querySelector('[role="tablist"]'));

// ---- messages of the program

for (const type of ["hello", "progress", "exported"])
  connection.on(type, (message) => {
    state[type] = message;
    state.changed(type);
  });
connection.on("path", (message) => {
  if (message.revision !== state.design?.revision) return;
  clearMessage("equilibrium");
  state.path = message;
  state.changed("path");
});
connection.on("state", (message) => {
  const was = state.program.mode;
  state.program = message;
  if (was !== message.mode) clearMessage("equilibrium");
  forgetState(was !== message.mode);
  state.changed("program");
});
connection.on("meshes", ({bodies, hinges}) => (state.meshes = {bodies: bodies.map(decoded), hinges: hinges.map((mesh) => mesh && decoded(mesh))}));
connection.on("design", (design) => {
  const first = !state.design, same = !first && sameSheet(state.design, design);
  if (!first && state.design.revision !== design.revision) forgetDesign();
  if (!same) state.found = null;
  state.design = design;
  if (!same) newSheet(design, first);
  state.changed("design");
  marks();
});
connection.on("result", (message) => {
  if (message.revision !== state.design?.revision) return;
  state.result = message;
  state.found = message.result;
  scene.setGoal(ghostOf(state.design, state.found));
  layGoal();
  lookAt(message.result);
  state.changed("result");
});
connection.on("frame", (frame) => {
  const {design} = state;
  if (!design || frame.bodies !== design.structure.bodies.length || frame.revision !== design.revision) return;
  const wasIn = state.frame?.mode;
  state.frame = frame;
  if (!scene.stand || (wasIn !== frame.mode && frame.mode !== "bullet")) stand(frame);
  scene.show(frame.poses, {settle: frame.mode !== "bullet" && !dragTool.held});
  layGoal();
  dragTool.thread();
  if (state.fitting) state.fitting = false, scene.fit();
  state.changed("frame");
});
connection.on("error", ({message, about}) => showMessage(message, {about}));
connection.on("done", ({type}) => (clearMessage(type), type === "reset" && clearMessage("equilibrium")));
connection.on("saved", (message) => (clearMessage("saved"), showMessage(`Saved: ${message.path}, ${describeSaved(message)}.`, {good: true, about: "saved"})));
connection.on("closed", () => state.design && showMessage("The program has ended or was stopped. This page looks for it again."));
connection.on("open", () => $("messages").replaceChildren());

/** Describes the fold of the saved design, and whether it is the shown fold. */
function describeSaved({theta_rad, at_fold}) {
  if (state.design.bodies) return `turned as ${at_fold ? "it is shown" : "in the design"}`;
  if (at_fold) return `folded as it is shown, ${describeFold(theta_rad)}`;
  const shown = state.frame?.theta, is_other = Number.isFinite(shown) && Math.abs(shown - theta_rad) > radians(0.05);
  return `${state.design.has_result ? "folded as found" : "folded as in the design"}, ${describeFold(theta_rad)}${is_other ? `, not as shown, ${describeFold(shown)}` : ""}`;
}

/** Sets the view for a result: pictures and outlines from above, everything else slanted. */
function lookAt(result) {
  const {view = "slant", light = false} = goalOf(result) ?? {};
  $("view").value = view;
  scene.orbit.view(view);
  if (light) $("colour").value = "light";
  else if ($("colour").value === "light") $("colour").value = "plain";
  marks();
  state.fitting = true;
}

function sameSheet(a, b) {
  const {structure: p} = a, {structure: q} = b;
  return JSON.stringify([p.bodies, p.hinges, p.wall_mm]) === JSON.stringify([q.bodies, q.hinges, q.wall_mm]);
}

function newSheet(design, first) {
  const before = scene.rest?.length, size = scene.size;
  scene.setStructure(design.structure, {fit: false, meshes: design.bodies ? state.meshes : null});
  scene.stand = null;
  state.motion = design.exact && !design.bodies ? exactMotion(design.structure, design.family) : null;
  state.fitting = first || before !== scene.rest.length || Math.abs(size - scene.size) > 0.05 * size;
  scene.setGoal(ghostOf(design, state.found));
}

let laid = null;  // placement of the goal on the closed form, for one result and motion; it stays while the sheet folds further

/** Places the goal on the shown sheet: on its closed form at the result's fold, or on an equilibrium or simulated
 *  shape as it is. */
function layGoal() {
  const {frame, found, motion, design} = state, theta = found?.states?.find(({name}) => name === "target")?.theta_rad, cell = design?.structure.cell_mm;
  if (!found || !frame) return;
  if (frame.mode !== "exact" || !motion || !Number.isFinite(theta)) return scene.placeGoal(placementOf(found, frame.poses, cell));
  if (laid?.found !== found || laid.motion !== motion) laid = {found, motion, at: placementOf(found, motion(theta), cell)};
  scene.placeGoal(laid.at);
}

/** Sets the orientation: exact sheets from a well folded shape, to keep them from turning over during the motion;
 *  others from the frame; bodies as drawn. */
function stand(frame) {
  if (state.design.bodies) return scene.standBy(null);
  const theta = Math.max(Math.abs(frame.theta) || 0, STAND_THETA) * (frame.theta < 0 ? -1 : 1);
  scene.standBy(state.motion ? state.motion(Math.min(theta, state.design.theta_range_rad?.[1] || theta)) : frame.poses);
}

// ---- colours

/** Returns the turn of each hinge as a fraction of the largest turn. */
function turns() {
  const {structure} = state.design, {poses} = scene;
  const turn = structure.hinges.map(({bodies: [a, b]}) => turnBetween(poses, a, b));
  const most = Math.max(...turn, 1e-9);
  return turn.map((value) => value / most);
}

/** Shows the axes of the turned hinge, unless bodies are pulled, and of the chosen hinges. */
function axes() {
  const {driven, pulled} = state.design.bodies, turned = pulled ? [] : [driven];
  const chosen = state.chosen.filter((hinge) => !turned.includes(hinge));
  scene.setAxes([...turned.map((hinge) => ({hinge, colour: "goal"})), ...chosen.map((hinge) => ({hinge, colour: "accent"}))]);
}

function marks() {
  if (!state.design) return;
  const {structure, breaking = []} = state.design, choice = $("colour").value;
  scene.setShining(choice === "light");
  scene.setMarked({bad: breaking, chosen: state.chosen, fixed: state.program.fixed ?? [], bodies: state.body === null ? [] : [state.body]});
  if (state.design.bodies) axes();
  const tilts = structure.hinges.map(({beta_rad}) => Math.abs(beta_rad)), most = Math.max(...tilts, 1e-9), bad = new Set(breaking);
  const off = choice === "distance" ? distancesOf(state.found) : null, farthest = Math.max(...(off ?? []), 1e-9);
  if (choice === "distance") status(off ? `pale: on the goal, dark: ${neat(farthest, 2)} mm from it` : "Distances from a goal are known after a search for a curve, a helmet or ribs");
  if (off) return scene.setHeat(off.map((v) => v / farthest), "body");
  scene.setHeat({tilt: tilts.map((v) => v / most), turn: choice === "turn" ? turns() : null, error: structure.hinges.map((_, k) => (bad.has(k) ? 1 : 0))}[choice] ?? null);
}
state.on("chosen", marks);
state.on("body", marks);
state.on("program", marks);
$("colour").addEventListener("change", () => (status(""), marks()));
state.on("frame", () => $("colour").value === "turn" && scene.setHeat(turns()));

// ---- before and after

let beforeScene = null;
state.remember = () => {
  if (state.design && state.frame) state.before = {design: state.design, poses: state.frame.poses.slice()};
};
function compare(on) {
  if (on && !state.before) return status("nothing to compare with yet: search, or set this design as the reference");
  $("compare").setAttribute("aria-pressed", String(on));
  show($("before_view"), on);
  show($("caption_now"), on);
  if (!on) return;
  beforeScene ??= new Scene($("before"));
  beforeScene.setStructure(state.before.design.structure);
  beforeScene.standBy(state.before.poses);
  beforeScene.show(state.before.poses);
  beforeScene.resize();
  beforeScene.fit();
}
$("compare").addEventListener("click", () => compare($("compare").getAttribute("aria-pressed") !== "true"));
$("remember").addEventListener("click", () => {
  state.remember();
  status("Reference saved. Compare shows it next to later versions", () => Boolean(state.before));
});

// ---- buttons and keys

const send = (type) => connection.send(type).catch(() => {});
for (const type of ["undo", "redo", "save"]) $(type).addEventListener("click", () => send(type));
$("save_fold").addEventListener("click", () => connection.send("save", {at_fold: true}).catch(() => {}));
$("release").addEventListener("click", () => dragTool.letGo());
$("view").addEventListener("change", () => scene.orbit.view($("view").value));
for (const input of document.querySelectorAll('input[name="tool"]')) input.addEventListener("change", () => ($("stage").dataset.tool = input.value));
$("fit").addEventListener("click", () => scene.fit());
$("full").addEventListener("click", () => (document.fullscreenElement ? document.exitFullscreen() : $("stage").requestFullscreen?.()));
$("photo").addEventListener("click", async () => saveAs(await scene.picture(), `${state.design?.name ?? "kinetix"}.png`));

show($("film"), canRecord($("scene")));
listenForFilm($("film"), () => scene, () => state.design?.name ?? "kinetix", showMessage);

function shortcut(event) {
  const key = event.key.toLowerCase();
  if (!(event.ctrlKey || event.metaKey)) return false;
  const type = key === "s" ? "save" : key === "y" || (key === "z" && event.shiftKey) ? "redo" : key === "z" ? "undo" : null;
  if (type) send(type);
  return type !== null;
}

function foldBy(deg) {
  const next = Math.max(Number($("theta").min), Math.min(Number($("theta").max), Number($("theta").value) + deg));
  $("theta").value = next;
  bar.fold(next);
}

function sceneKey(event) {
  if (scene.orbit.key(event) || dragTool.key(event)) return true;
  if (event.ctrlKey || event.metaKey || event.altKey) return false;
  const act = {f: () => scene.fit(), " ": () => bar.play(!bar.playing), p: () => $("pause").click(), "[": () => foldBy(-1), "]": () => foldBy(1)}[event.key.toLowerCase()];
  act?.();
  return Boolean(act);
}

document.addEventListener("keydown", (event) => {
  const typing = event.target.closest?.("input, textarea, select") && !["range", "radio", "checkbox"].includes(event.target.type);
  if (event.key === "Escape") dragTool.letGo();
  if ((!typing && shortcut(event)) || (event.target === scene.canvas && sceneKey(event))) event.preventDefault();
});
window.addEventListener("error", ({message}) => showMessage(`Error in this page: ${message}`));
for (const [when, paper] of [["beforeprint", true], ["afterprint", false]])
  window.addEventListener(when, () => {
    if (paper) document.documentElement.dataset.theme = "light";
    else delete document.documentElement.dataset.theme;
    scene.recolour();
    scene.resize();
    scene.draw(performance.now());
  });

// ---- for tests and scripts (studio-protocol.md section 2)

let ready;
window.kinetix = {
  ready: new Promise((resolve) => (ready = resolve)),
  get bodies() { return state.design?.structure.bodies.length ?? 0; },
  get design() { return state.design; },
  get state() { return state.program; },
  get frame() { return state.frame; },
  poses: () => Array.from({length: state.frame?.bodies ?? 0}, (_, k) => [...state.frame.poses.subarray(7 * k, 7 * k + 7)]),
  theta: () => degrees(state.frame?.theta ?? NaN),
  send: (type, keys) => connection.send(type, keys),
  mode: (mode) => connection.send("mode", {mode}),
  setTheta: (deg) => connection.send("theta", {deg}),
  drag: (body, to) => connection.send("drag", {body, to}),
  release: () => connection.send("release"),
  fix: (body, fixed) => connection.send("fix", {body, fixed}),
  setHinge: (index, keys) => connection.send("hinge", {index, ...keys}),
  onPage: (body) => scene.onPage([...state.frame.poses.subarray(7 * body, 7 * body + 3)]),
  get frames() { return scene.frames; },
  scene,
};
state.on("frame", () => ready(), {once: true});
connection.open();
