// Light probes for three.js, out of light_probes.json and the .bin files beside it.
//
//     import * as THREE from 'three';
//     import { LightProbeGridWebGL } from 'three/addons/lighting/LightProbeGridWebGL.js';
//     import { loadProbes } from './probes.js';
//     const volumes = await loadProbes(THREE, 'light_probes.json');
//     for (const volume of volumes) scene.add(volume.lightProbeGrid(LightProbeGridWebGL));
//
// LightProbeGrid is in three.js since r184. Without it: volume.lightProbe(place) for one object, or
// volume.material() for a surface that looks its light up in each pixel.
// Coefficients are of radiance, SphericalHarmonics3's, along three.js' axes (Y up).

const BASIS = `
vec3 probeLight(vec3 c[9], vec3 n) {  // E/pi: harmonics times 1, 2/3 and 1/4
  return max(vec3(0.0), 0.28209479 * c[0] + 0.32573501 * (c[1] * n.y + c[2] * n.z + c[3] * n.x)
    + 0.27313711 * (c[4] * n.x * n.y + c[5] * n.y * n.z + c[7] * n.x * n.z)
    + 0.07884789 * c[6] * (3.0 * n.z * n.z - 1.0) + 0.13656855 * c[8] * (n.x * n.x - n.y * n.y));
}`;

function halfToFloat(bits) {
  const sign = bits & 0x8000 ? -1 : 1, exponent = bits >> 10 & 31, fraction = bits & 1023;
  return sign * (exponent === 0 ? fraction * 2 ** -24 : (1024 + fraction) * 2 ** (exponent - 25));
}

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const length = (a) => Math.sqrt(dot(a, a));

class PointProbes {
  constructor(THREE, about) {
    Object.assign(this, { THREE, name: about.name, isGrid: false, about });
  }

  // 27 numbers, of the nearest probe.
  coefficientsAt(place) {
    let best = null, least = Infinity;
    this.about.positions.forEach((position, index) => {
      const away = [position[0] - place.x, position[1] - place.y, position[2] - place.z], square = dot(away, away);
      if (square < least) [best, least] = [index, square];
    });
    return best === null ? new Array(27).fill(0) : this.about.coefficients[best];
  }

  lightProbe(place) {
    const { LightProbe, SphericalHarmonics3 } = this.THREE;
    return new LightProbe(new SphericalHarmonics3().fromArray(this.coefficientsAt(place)));
  }
}

class BoxOfProbes extends PointProbes {
  constructor(THREE, about, halves) {
    super(THREE, about);
    const [x, y, z] = about.resolution;
    if (halves.length !== 4 * x * y * 7 * (z + 2)) throw new Error(about.file + ' does not fit light_probes.json');
    Object.assign(this, { isGrid: true, resolution: about.resolution, halves });
    const texture = new THREE.Data3DTexture(halves, x, y, 7 * (z + 2));
    texture.format = THREE.RGBAFormat;
    texture.type = THREE.HalfFloatType;
    texture.minFilter = texture.magFilter = THREE.LinearFilter;
    texture.unpackAlignment = 1;
    texture.needsUpdate = true;
    this.texture = texture;
  }

  // World space, of the probe x, y, z.
  place(x, y, z) {
    const { first, steps } = this.about;
    return new this.THREE.Vector3(...first.map((f, c) => f + x * steps[0][c] + y * steps[1][c] + z * steps[2][c]));
  }

  // A matrix from world space to steps from the first probe.
  coordinates() {
    const [a, b, c] = this.about.steps.map((step) => new this.THREE.Vector3(...step));
    return new this.THREE.Matrix4().makeBasis(a, b, c).setPosition(this.place(0, 0, 0)).invert();
  }

  // 27 numbers between the eight probes around, trilinear; beyond the box those of its border.
  coefficientsAt(place) {
    const at = new this.THREE.Vector3(place.x, place.y, place.z).applyMatrix4(this.coordinates()).toArray();
    const low = [], share = [];
    this.resolution.forEach((count, k) => {
      const inside = Math.min(Math.max(at[k], 0), count - 1);
      low[k] = Math.max(0, Math.min(Math.floor(inside), count - 2));
      share[k] = inside - low[k];
    });
    const sum = new Array(27).fill(0);
    for (let corner = 0; corner < 8; corner++) {
      const far = [corner & 1, corner >> 1 & 1, corner >> 2 & 1];
      const weight = far.reduce((product, f, k) => product * (f ? share[k] : 1 - share[k]), 1);
      if (weight === 0) continue;
      const numbers = this.probe(...low.map((l, k) => l + far[k]));
      for (let i = 0; i < 27; i++) sum[i] += weight * numbers[i];
    }
    return sum;
  }

  probe(x, y, z) {
    const [nx, ny, nz] = this.resolution, numbers = [];
    for (let i = 0; i < 27; i++) {
      const slice = (i >> 2) * (nz + 2) + 1 + z;
      numbers.push(halfToFloat(this.halves[4 * (x + nx * (y + ny * slice)) + (i & 3)]));
    }
    return numbers;
  }

  // Lights every standard material of a scene that it is added to. Its boxes lie along the world's axes.
  // Up to r186 the outermost probes stood on the box's sides, since r187 half a step within.
  lightProbeGrid(LightProbeGrid) {
    if (!this.about.alongAxes) throw new Error(`'${this.name}' is turned; LightProbeGrid is not: use material()`);
    const steps = this.about.steps.map(length), first = this.place(0, 0, 0);
    const last = this.place(...this.resolution.map((count) => count - 1)), found = new this.THREE.Vector3();
    for (const beyond of [0, -1]) {
      const size = steps.map((step, k) => step * Math.max(this.resolution[k] + beyond, this.resolution[k] > 1 ? 0 : 1));
      const grid = new LightProbeGrid(...size, ...this.resolution);
      grid.position.copy(first).lerp(last, 0.5);
      grid.updateBoundingBox();
      if (grid.getProbePosition(0, 0, 0, found).distanceTo(first) > 1e-3 * Math.min(...steps)) continue;
      grid.texture = this.texture;
      grid.name = this.name;
      return grid;
    }
    throw new Error('this LightProbeGrid places its probes in a way that is not known here');
  }

  // Uniforms and a function `vec3 probesAt(vec3 place, vec3 normal)` (E/pi, world space) for a ShaderMaterial's text.
  shaderUniforms() {
    const { Vector3 } = this.THREE;
    return {
      probesAtlas: { value: this.texture },
      probesCoordinates: { value: this.coordinates() },
      probesResolution: { value: new Vector3(...this.resolution) },
    };
  }

  static get shaderText() {
    return `
uniform highp sampler3D probesAtlas;
uniform mat4 probesCoordinates;
uniform vec3 probesResolution;
${BASIS}
vec4 probesPack(vec3 at, float pack) {
  float depth = probesResolution.z + 2.0;
  return texture(probesAtlas, vec3(at.xy / probesResolution.xy, (at.z + pack * depth + 1.0) / (7.0 * depth)));
}
vec3 probesAt(vec3 place, vec3 normal) {
  vec3 at = clamp((probesCoordinates * vec4(place, 1.0)).xyz, vec3(0.0), probesResolution - 1.0) + 0.5;
  vec4 p[7];
  for (int i = 0; i < 7; i++) p[i] = probesPack(at, float(i));
  vec3 c[9];
  c[0] = p[0].xyz;
  c[1] = vec3(p[0].w, p[1].xy);
  c[2] = vec3(p[1].zw, p[2].x);
  c[3] = p[2].yzw;
  c[4] = p[3].xyz;
  c[5] = vec3(p[3].w, p[4].xy);
  c[6] = vec3(p[4].zw, p[5].x);
  c[7] = p[5].yzw;
  c[8] = p[6].xyz;
  return probeLight(c, normal);
}`;
  }

  // White unless told: `albedo` times the light of the probes, nothing else. Works with turned boxes.
  material(albedo = 0xffffff) {
    return new this.THREE.ShaderMaterial({
      uniforms: { ...this.shaderUniforms(), albedo: { value: new this.THREE.Color(albedo) } },
      vertexShader: `
varying vec3 place;
varying vec3 worldNormal;
void main() {
  vec4 world = modelMatrix * vec4(position, 1.0);
  place = world.xyz;
  worldNormal = transpose(inverse(mat3(modelMatrix))) * normal;
  gl_Position = projectionMatrix * viewMatrix * world;
}`,
      fragmentShader: `
varying vec3 place;
varying vec3 worldNormal;
uniform vec3 albedo;
${BoxOfProbes.shaderText}
void main() {
  gl_FragColor = linearToOutputTexel(vec4(albedo * probesAt(place, normalize(worldNormal)), 1.0));
}`,
    });
  }
}

// All volumes of a light_probes.json. `THREE`: the module of three.js.
export async function loadProbes(THREE, url) {
  const base = new URL(url, globalThis.document ? document.baseURI : import.meta.url);
  const get = async (address) => {
    const answer = await fetch(address);
    if (!answer.ok) throw new Error(`${address}: ${answer.status}`);
    return answer;
  };
  const about = await (await get(base)).json();
  if (about.version !== 1) throw new Error(`${base}: version ${about.version} is not known here`);
  return Promise.all(about.volumes.map(async (volume) => {
    if (!volume.file) return new PointProbes(THREE, volume);
    const bytes = await (await get(new URL(encodeURIComponent(volume.file), base))).arrayBuffer();
    return new BoxOfProbes(THREE, volume, new Uint16Array(bytes));
  }));
}
