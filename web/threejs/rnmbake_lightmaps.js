// Directional lightmaps for three.js, out of lightmaps.json and the pages beside it.
//
//     import * as THREE from 'three';
//     import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
//     import { loadLightmaps } from './rnmbake_lightmaps.js';
//     const gltf = await new GLTFLoader().loadAsync('scene.glb');
//     const lightmaps = await loadLightmaps(gltf, 'lightmaps.json');
//     scene.add(gltf.scene);
//     lightmaps.intensity = 1;
//
// Every standard material of the scene's lightmapped objects then reads its light from the pages, for the normal that its
// normal map has there. Needs three.js r155 or newer (light in physical units).
import * as THREE from 'three';

const UV_CHANNEL = 1;  // TEXCOORD_1 of the .glb

class Lightmaps {
  constructor(record, pages) {
    this.record = record;
    this.pages = pages;  // of each, the textures of its layers in the decoder's order
    this.materials = new Set();
    this.uniforms = { rnmbakeFlat: { value: 0 } };
  }

  // A factor for all baked light.
  set intensity(value) {
    for (const material of this.materials) material.lightMapIntensity = value;
  }

  // Decodes for the surface's own normal alone, as a plain lightmap is; to compare with.
  set flat(value) {
    this.uniforms.rnmbakeFlat.value = value ? 1 : 0;
  }

  light(material, page) {
    if (this.materials.has(material)) return;
    this.materials.add(material);
    const textures = this.pages[page], { decoder, green } = this.record;
    material.lightMap = textures[0];  // makes three.js hand over the second UV set
    material.onBeforeCompile = (shader) => {
      Object.assign(shader.uniforms, this.uniforms);
      textures.forEach((value, k) => { shader.uniforms['rnmbakeLayer' + k] = { value }; });
      shader.fragmentShader = shader.fragmentShader
        .replace('void main() {', declarations(decoder, green, textures.length) + '\nvoid main() {')
        .replace('#include <lights_fragment_maps>', lightFromPages());
    };
    material.customProgramCacheKey = () => 'rnmbake ' + decoder.function + textures.length + green;
    material.needsUpdate = true;
  }
}

function declarations(decoder, green, count) {
  const layers = Array.from({ length: count }, (_, k) => k);
  return `uniform float rnmbakeFlat;
${layers.map((k) => `uniform sampler2D rnmbakeLayer${k};`).join('\n')}
${decoder.text}
// E/pi for a unit normal in tangent space, y up.
vec3 rnmbakeLight(vec2 uv, vec3 n) {
  n = normalize(mix(n, vec3(0.0, 0.0, 1.0), rnmbakeFlat));
  n.y *= ${green === 'y-down' ? '-1.0' : '1.0'};
  return max(${decoder.function}(${layers.map((k) => `texture2D(rnmbakeLayer${k}, uv).rgb`).join(', ')}, n), vec3(0.0));
}`;
}

// normalScale of a glTF's material may have its y turned, for tangents that three.js derives from the UVs.
function lightFromPages() {
  const line = 'vec3 lightMapIrradiance = lightMapTexel.rgb * lightMapIntensity;';
  const chunk = THREE.ShaderChunk.lights_fragment_maps;
  if (!chunk.includes(line)) throw new Error('rnmbake_lightmaps.js does not know this version of three.js: r' + THREE.REVISION);
  return chunk.replace(line, `
    vec3 rnmbakeNormal = vec3(0.0, 0.0, 1.0);
    #ifdef USE_NORMALMAP_TANGENTSPACE
      rnmbakeNormal = texture2D(normalMap, vNormalMapUv).xyz * 2.0 - 1.0;
      rnmbakeNormal.xy *= abs(normalScale);
      rnmbakeNormal = normalize(rnmbakeNormal);
    #endif
    vec3 lightMapIrradiance = PI * lightMapIntensity * rnmbakeLight(vLightMapUv, rnmbakeNormal);`);
}

// Formats of KTX2 files, by their numbers in Vulkan: three.js's format and type, and how its typed array is called.
const KTX2_FORMATS = {
  97: [THREE.RGBAFormat, THREE.HalfFloatType, Uint16Array],
  122: [THREE.RGBFormat, THREE.UnsignedInt101111Type, Uint32Array],
  123: [THREE.RGBFormat, THREE.UnsignedInt5999Type, Uint32Array],
  143: [THREE.RGB_BPTC_UNSIGNED_Format],  // blocks: needs EXT_texture_compression_bptc
  144: [THREE.RGB_BPTC_SIGNED_Format],
};

// Without a renderer, which KTX2Loader wants for formats that are transcoded; these are not, and it passes BC6H over.
async function loadKtx2(url) {
  const { read } = await import('three/addons/libs/ktx-parse.module.js');
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`${url}: ${answer.status} ${answer.statusText}`);
  const file = read(new Uint8Array(await answer.arrayBuffer()));
  const [format, type, Numbers] = KTX2_FORMATS[file.vkFormat] || [];
  if (format === undefined) throw new Error(`${url} has texels of a format that is not known here: ${file.vkFormat}`);
  let decode = (level) => level.levelData.slice();
  if (file.supercompressionScheme) {
    const { ZSTDDecoder } = await import('three/addons/libs/zstddec.module.js');
    const zstd = new ZSTDDecoder();
    await zstd.init();
    decode = (level) => zstd.decode(level.levelData, level.uncompressedByteLength).slice();
  }
  const mipmaps = file.levels.map((level, k) => {
    const bytes = decode(level);
    return { data: Numbers ? new Numbers(bytes.buffer) : bytes,
      width: Math.max(1, file.pixelWidth >> k), height: Math.max(1, file.pixelHeight >> k) };
  });
  const { data, width, height } = mipmaps[0];
  const texture = Numbers ? new THREE.DataTexture(data, width, height, format, type) : new THREE.CompressedTexture(mipmaps, width, height, format);
  texture.mipmaps = mipmaps.length > 1 || !Numbers ? mipmaps : [];
  texture.needsUpdate = true;
  return texture;
}

// Both loaders put the last row first.
async function loadPicture(url) {
  if (url.endsWith('.exr')) {
    const { EXRLoader } = await import('three/addons/loaders/EXRLoader.js');
    return new EXRLoader().loadAsync(url);
  }
  const { HDRLoader } = await import('three/addons/loaders/HDRLoader.js');
  return new HDRLoader().loadAsync(url);
}

async function loadLayer(url) {
  const isKtx2 = url.endsWith('.ktx2'), texture = await (isKtx2 ? loadKtx2(url) : loadPicture(url));
  texture.magFilter = THREE.LinearFilter;
  texture.minFilter = texture.mipmaps.length > 1 ? THREE.LinearMipmapLinearFilter : THREE.LinearFilter;
  texture.generateMipmaps = false;
  texture.channel = UV_CHANNEL;
  if (!isKtx2) {  // the last row is first, and a glTF's v runs downwards
    texture.repeat.y = -1;
    texture.offset.y = 1;
  }
  return texture;
}

async function loadPage(page, layers, base) {
  return Promise.all(layers.map((layer) => loadLayer(new URL(page.layers[layer || 'flat'], base).href)));
}

// The meshes of a node itself, not of those below it: one, or one for each of its materials.
function meshesOf(object) {
  if (object.isMesh) return [object];
  return object.children.filter((child) => child.isMesh && child.name.startsWith(object.name));
}

// `gltf`: what GLTFLoader made of the scene.glb beside `url`.
export async function loadLightmaps(gltf, url) {
  const base = new URL(url, document.baseURI), answer = await fetch(base);
  if (!answer.ok) throw new Error(`${url}: ${answer.status} ${answer.statusText}`);
  const record = await answer.json();
  if (record.schema_version !== 1) throw new Error(`${url} is of another version of rnmbake`);
  const pages = await Promise.all(record.pages.map((page) => loadPage(page, record.decoder.layers, base)));
  const lightmaps = new Lightmaps(record, pages);
  for (const placed of record.objects) {
    const object = await gltf.parser.getDependency('node', placed.node);
    for (const mesh of meshesOf(object)) lightmaps.light(mesh.material, placed.page);
  }
  return lightmaps;
}
