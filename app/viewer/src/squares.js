// Squares by their places in the lattice, as in model/lattice/square: vertices [i, j], walls and cells between them.

const isOdd = (n) => Math.abs(n % 2) === 1;

export const isSquare = ({bodies, cells}) => bodies.every(({vertex}) => vertex?.length === 2) && cells.every(({hinges}) => hinges.length === 4);

/** Returns +1 for bodies that turn with theta, -1 for the others, 0 in other lattices. */
export const senseOf = ({vertex}) => (vertex?.length === 2 ? (isOdd(vertex[0] + vertex[1]) ? -1 : 1) : 0);

/** Returns a wall's direction, x (0) or y (1), and its tilt without the sign that alternates along its crease. */
export function wallOf(structure, hinge) {
  const [a, b] = hinge.bodies.map((body) => structure.bodies[body].vertex);
  const along = a[1] === b[1] ? 0 : 1, place = along === 0 ? a[1] : a[0];
  return {along, tilt: (isOdd(place) ? -1 : 1) * hinge.beta_rad};
}

/** Returns the cell at a place in half cell edges; null on walls and corners. */
export const cellAt = ([x, y]) => (isOdd(x) && isOdd(y) ? [(x - 1) / 2, (y - 1) / 2] : null);
