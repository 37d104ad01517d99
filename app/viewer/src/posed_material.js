// Materials whose corners move with their body: the poses of all bodies lie in one small texture, which is all that a new
// pose has to fill.
import * as THREE from "three";

const DECLARE = `
  attribute float body;
  uniform sampler2D poses;
  vec3 turnedBy(vec4 q, vec3 v) { vec3 t = 2.0 * cross(q.yzw, v); return v + q.x * t + cross(q.yzw, t); }
  vec4 posePart(int part) { int at = 2 * int(body + 0.5) + part; int width = textureSize(poses, 0).x;
    return texelFetch(poses, ivec2(at % width, at / width), 0); }
`;

/** Two texels a body: place, then quaternion. */
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

/** The same material, moved by those poses. */
export function posed(material, texture) {
  material.onBeforeCompile = (shader) => {
    shader.uniforms.poses = {value: texture};
    shader.vertexShader = DECLARE + shader.vertexShader
      .replace("#include <beginnormal_vertex>", "vec3 objectNormal = turnedBy(posePart(1), normal);")
      .replace("#include <begin_vertex>", "vec3 transformed = turnedBy(posePart(1), position) + posePart(0).xyz;");
  };
  return material;
}
