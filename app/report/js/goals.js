// The kinds of goals that a report knows: one line each. A kind has
//   name          key of its section in result.json
//   read          the result -> what its sections need; `reasons` and `physicsReasons`: why it was missed;
//                 `goal`, `drawn`: lines seen from the side; `backdrop`: lines in space; `turn`: by column
//   place         moves states into the frame of the pictures (optional)
//   view          how the folded shape is best seen: side, top or slant
//   bottom        three bodies of the part that the folded thing stands on (optional)
//   backdropKey   [class, words] of the backdrop in a legend (optional)
//   verdict       {mark, tone, title, text}
//   numbers       key numbers for the top of the page
//   fitText       how the error of a start of the search reads, where it is no share of the goal's size (optional)
//   standing      (data, width, most height) -> the picture of the first screen in place of walls (optional)
//   facts         more rows [name, words] of the first screen (optional)
//   hasNoLayout   its own section takes the place of the flat layout (optional)
//   firstSections, lastSections   [id, title, content], before and after what all results have
const GOALS = [
  curveGoal,
  displayGoal,
  foldGoal,
  helmetGoal,
  outlineGoal,
  surfaceGoal,
  space_blockGoal,
  space_curveGoal,
  ownGoal,
];
