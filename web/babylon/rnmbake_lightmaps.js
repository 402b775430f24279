// Directional lightmaps for Babylon.js, out of lightmaps.json and the pages beside it.
//
//     import { ImportMeshAsync } from '@babylonjs/core/Loading/sceneLoader.js';
//     import '@babylonjs/loaders/glTF/2.0/index.js';
//     import { loadLightmaps } from './rnmbake_lightmaps.js';
//     const loaded = await ImportMeshAsync('scene.glb', scene);
//     const lightmaps = await loadLightmaps(loaded, scene, 'lightmaps.json');
//     lightmaps.intensity = 1;
//
// Every PBR material of the scene's lightmapped objects then reads its light from the pages, for the normal that its normal map
// has there. Made for Babylon.js 9.35 on WebGL 2 (the decoder is GLSL).
import { Constants } from '@babylonjs/core/Engines/constants.js';
import { MaterialPluginBase } from '@babylonjs/core/Materials/materialPluginBase.js';
import { RawTexture } from '@babylonjs/core/Materials/Textures/rawTexture.js';

class LightmapPlugin extends MaterialPluginBase {
  constructor(material, lightmaps, textures) {
    super(material, 'RnmbakeLightmap', 200, { RNMBAKE: false }, true, true);
    this.lightmaps = lightmaps;
    this.textures = textures;
    this.doNotSerialize = true;
  }

  getClassName() {
    return 'RnmbakeLightmapPlugin';
  }

  // vMainUV2 is TEXCOORD_1 of the .glb.
  prepareDefinesBeforeAttributes(defines) {
    defines.RNMBAKE = true;
    defines._needUVs = true;
    defines.MAINUV2 = true;
  }

  isReadyForSubMesh() {
    return this.textures.every((texture) => texture.isReady());
  }

  getActiveTextures(active) {
    active.push(...this.textures);
  }

  hasTexture(texture) {
    return this.textures.includes(texture);
  }

  getSamplers(samplers) {
    samplers.push(...this.textures.map((_, k) => 'rnmbakeLayer' + k));
  }

  getUniforms() {
    return { ubo: [{ name: 'rnmbakeControls', size: 2, type: 'vec2' }], fragment: 'uniform vec2 rnmbakeControls;' };
  }

  bindForSubMesh(uniforms) {
    uniforms.updateFloat2('rnmbakeControls', this.lightmaps.intensity, this.lightmaps.flat ? 1 : 0);
    this.textures.forEach((texture, k) => uniforms.setTexture('rnmbakeLayer' + k, texture));
  }

  getCustomCode(shader) {
    if (shader !== 'fragment') return null;
    return {  // the base class asks for the names of these points before there are lightmaps
      CUSTOM_FRAGMENT_DEFINITIONS: this.lightmaps ? declarations(this.lightmaps.record, this.textures.length) : '',
      CUSTOM_FRAGMENT_BEFORE_FINALCOLORCOMPOSITION: LIGHT_FROM_PAGES,
    };
  }
}

function declarations({ decoder, green }, count) {
  const layers = Array.from({ length: count }, (_, k) => k);
  return `${layers.map((k) => `uniform sampler2D rnmbakeLayer${k};`).join('\n')}
${decoder.text}
// E/pi for a normal in tangent space, y up.
vec3 rnmbakeLight(vec2 uv, vec3 n) {
  n = normalize(mix(n, vec3(0.0, 0.0, 1.0), rnmbakeControls.y));
  n.y *= ${green === 'y-down' ? '-1.0' : '1.0'};
  return max(${decoder.function}(${layers.map((k) => `texture2D(rnmbakeLayer${k}, uv).rgb`).join(', ')}, n), vec3(0.0));
}`;
}

// Babylon's own lightmap is added to the picture without the albedo; this is diffuse light.
const LIGHT_FROM_PAGES = `
#ifndef UNLIT
  vec3 rnmbakeNormal = vec3(0.0, 0.0, 1.0);
  #if defined(BUMP) && !defined(OBJECTSPACE_NORMALMAP)
    rnmbakeNormal = texture2D(bumpSampler, vBumpUV + uvOffset).xyz * 2.0 - 1.0;
    #ifdef NORMALXYSCALE
      rnmbakeNormal.xy *= vBumpInfos.y;
    #endif
  #endif
  vec3 rnmbakeDiffuse = rnmbakeControls.x * rnmbakeLight(vMainUV2, rnmbakeNormal) * surfaceAlbedo;
  #if defined(METALLICWORKFLOW) && !defined(LEGACY_SPECULAR_ENERGY_CONSERVATION)
    rnmbakeDiffuse *= 1.0 - reflectivityOut.metallic;
  #endif
  finalDiffuse += rnmbakeDiffuse;
#endif`;

class Lightmaps {
  constructor(record, pages) {
    this.record = record;
    this.pages = pages;  // of each, the textures of its layers in the decoder's order
    this.materials = new Set();
    this.intensity = 1;  // a factor for all baked light
    this.flat = false;  // decodes for the surface's own normal alone, as a plain lightmap is; to compare with
  }

  light(material, page) {
    if (this.materials.has(material)) return;
    this.materials.add(material);
    new LightmapPlugin(material, this, this.pages[page]);
  }
}

async function loadPage(scene, page, layers, base) {
  return Promise.all(layers.map(async (layer) => {
    const answer = await answerOf(new URL(page.layers[layer || 'flat'], base));
    const texels = new Uint16Array(await answer.arrayBuffer());
    return new RawTexture(texels, page.width, page.height, Constants.TEXTUREFORMAT_RGBA, scene, false, false,
      Constants.TEXTURE_BILINEAR_SAMPLINGMODE, Constants.TEXTURETYPE_HALF_FLOAT);
  }));
}

async function answerOf(url) {
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`${url}: ${answer.status} ${answer.statusText}`);
  return answer;
}

const ownRecord = (node) => node?.metadata?.gltf?.extras?.rnmbake;

// `loaded`: what ImportMeshAsync() or LoadAssetContainerAsync() made of the scene.glb beside `url`.
export async function loadLightmaps(loaded, scene, url) {
  const base = new URL(url, document.baseURI), record = await (await answerOf(base)).json();
  if (record.schema_version !== 1) throw new Error(`${url} is of another version of rnmbake`);
  const pages = await Promise.all(record.pages.map((page) => loadPage(scene, page, record.decoder.layers, base)));
  const lightmaps = new Lightmaps(record, pages);
  for (const mesh of loaded.meshes) {
    // A mesh of several materials is one below its node for each of them.
    const placed = ownRecord(mesh) ?? (mesh.name.startsWith(mesh.parent?.name + '_primitive') ? ownRecord(mesh.parent) : undefined);
    if (placed && mesh.material) lightmaps.light(mesh.material, placed.page);
  }
  return lightmaps;
}
