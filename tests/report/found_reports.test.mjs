// Reports of equilibria and of searches, in one page.
import "./equilibrium_renders.test.mjs";
import "./goals_renders.test.mjs";
