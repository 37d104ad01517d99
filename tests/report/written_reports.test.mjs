// Reports of written results and of sweeps, in one page.
import "./report_renders.test.mjs";
import "./made_renders.test.mjs";
import "./sweep_renders.test.mjs";
