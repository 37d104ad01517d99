// Kinds of goals that a report supports, one per line. A kind has these members; those marked (optional) can be absent.
//   name: key of its section in result.json.
//   read: function from the result to the data of its sections. `reasons` and `physicsReasons` state why it was missed.
//     `goal` and `drawn` are lines in side view, `backdrop` are lines in space, `turn` is a list by column.
//   place: moves states into the frame of the pictures (optional).
//   view: best view of the folded shape: side, top or slant.
//   bottom: three bodies of the part that the folded sheet stands on (optional).
//   backdropKey: [class, words] of the backdrop in a legend (optional).
//   describe: text.
//   numbers: key numbers for the top of the page.
//   fitText: formats the error of a start of the search, if it is not a share of the goal's size (optional).
//   standing: function from data to a picture for the first screen that replaces the walls (optional).
//   hasNoLayout: a section of the kind replaces the flat layout (optional).
//   firstSections, lastSections: [id, title, content], before and after the sections of all results.
const GOALS = [
  curveGoal,
  displayGoal,
  foldGoal,
  helmetGoal,
  outlineGoal,
  surfaceGoal,
  space_blockGoal,
  space_curveGoal,
  customGoal,
];
