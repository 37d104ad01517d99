// Exports for the report, as the global KinetixScene.
export {exactMotion} from "./fold.js";
export {pictureUnder} from "./ghost.js";
export {turnBetween} from "./quaternion.js";
export {storedMotion} from "./interpolate.js";
export {canRecord, listenForFilm, saveAs} from "./recording.js";
export {Scene} from "./scene.js";
export {decoded} from "./solids.js";
