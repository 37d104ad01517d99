// Materials whose corners move with their body. A small texture holds the poses of all bodies; a new pose changes only
// this texture.
import * as THREE from "three";

const DECLARE = `
  attribute float body;
  uniform sampler2D poses;
  vec4 bodyTurn; vec3 bodyPlace;
  void fetchPose() {
    int at = 2 * int(body + 0.5), width = textureSize(poses, 0).x;
    ivec2 place = ivec2(at % width, at / width);
    bodyPlace = texelFetch(poses, place, 0).xyz;
    bodyTurn = texelFetch(poses, place + ivec2(1, 0), 0);
  }
  vec3 turnedByBody(vec3 v) { vec3 t = 2.0 * cross(bodyTurn.yzw, v); return v + bodyTurn.x * t + cross(bodyTurn.yzw, t); }
`;

// Boundaries of faces are drawn in the fragment shader: separate lines would cost more than all faces.
const RIM_PX = "1.1";

/** Makes a texture with two texels per body: position, then quaternion. */
export function poseTexture(bodies) {
  const width = Math.min(1024, 2 * bodies), height = Math.ceil((2 * bodies) / width);
  const texture = new THREE.DataTexture(new Float32Array(4 * width * height), width, height, THREE.RGBAFormat, THREE.FloatType);
  texture.needsUpdate = true;
  return texture;
}

export function fillPoses(texture, poses) {
  const data = texture.image.data;
  for (let k = 0; 7 * k < poses.length; ++k) {
    data.set(poses.subarray(7 * k, 7 * k + 3), 8 * k);
    data.set(poses.subarray(7 * k + 3, 7 * k + 7), 8 * k + 4);
  }
  texture.needsUpdate = true;
}

/** Changes a material to move its corners by the poses in the texture. @param rim {value: colour} of the boundaries
 *  of faces, or nothing */
export function posed(material, texture, rim) {
  material.onBeforeCompile = (shader) => {
    shader.uniforms.poses = {value: texture};
    shader.vertexShader = DECLARE + shader.vertexShader
      .replace("void main() {", "void main() { fetchPose();")
      .replace("#include <beginnormal_vertex>", "vec3 objectNormal = turnedByBody(normal);")
      .replace("#include <begin_vertex>", "vec3 transformed = turnedByBody(position) + bodyPlace;");
    if (rim) drawRims(shader, rim);
  };
  material.customProgramCacheKey = () => `posed ${Boolean(rim)}`;
  return material;
}

function drawRims(shader, rim) {
  shader.uniforms.rimColour = rim;
  shader.vertexShader = "attribute vec4 rim; varying vec4 toSides;\n" + shader.vertexShader.replace("fetchPose();", "fetchPose(); toSides = rim;");
  shader.fragmentShader = "uniform vec3 rimColour; varying vec4 toSides;\n" + shader.fragmentShader.replace("#include <opaque_fragment>", `
    float side = min(min(toSides.x, toSides.y), min(toSides.z, toSides.w)), pixel = max(length(vec2(dFdx(side), dFdy(side))), 1e-6);
    outgoingLight = mix(rimColour, outgoingLight, 0.35 + 0.65 * smoothstep(0.0, ${RIM_PX}, side / pixel));
    #include <opaque_fragment>`);
}
