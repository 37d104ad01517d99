// Colours of the page as three.js objects.
import * as THREE from "three";

const FALLBACK = {paper: "#ffffff", plate: "#b9d6ee", soft: "#6f8f63", "plate-edge": "#2d5f8a", goal: "#c2560a", bad: "#c62828", accent: "#0b62a8", ground: "#e9edf1",
  "heat-none": "#dfe5ea", "heat-some": "#f0a646", "heat-most": "#8f1d1d"};

export function cssColour(name) {
  const text = getComputedStyle(document.documentElement).getPropertyValue("--scene-" + name).trim() ||
      getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();
  return new THREE.Color(text || FALLBACK[name] || "#888888");
}

/** Interpolates from none over some to most; share is 0 to 1. */
export function heat(share) {
  const at = Math.max(0, Math.min(1, share)), [a, b] = at < 0.5 ? ["heat-none", "heat-some"] : ["heat-some", "heat-most"];
  return cssColour(a).lerp(cssColour(b), at < 0.5 ? 2 * at : 2 * at - 1);
}
