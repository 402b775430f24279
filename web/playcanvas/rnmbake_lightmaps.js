// Directional lightmaps for PlayCanvas, out of lightmaps.json and the pages beside it.
//
//     import * as pc from 'playcanvas';
//     import { loadLightmaps } from './rnmbake_lightmaps.js';
//     app.assets.loadFromUrl('scene.glb', 'container', async (error, asset) => {
//       const lightmaps = await loadLightmaps(app, asset.resource, 'lightmaps.json');
//       app.root.addChild(asset.resource.instantiateRenderEntity());
//       lightmaps.intensity = 1;
//     });
//
// Every material of the scene's lightmapped objects then reads its light from the pages, for the normal that its normal map
// has there. Made for PlayCanvas 2.23 on a WebGL 2 device (the chunk is GLSL).
import * as pc from 'playcanvas';

const UV_SET = 1;  // TEXCOORD_1 of the .glb

class Lightmaps {
  constructor(record, pages) {
    this.record = record;
    this.pages = pages;  // of each, the textures of its layers in the decoder's order
    this.materials = new Set();
  }

  // A factor for all baked light.
  set intensity(value) {
    this.setAll('rnmbakeIntensity', value);
  }

  // Decodes for the surface's own normal alone, as a plain lightmap is; to compare with.
  set flat(value) {
    this.setAll('rnmbakeFlat', value ? 1 : 0);
  }

  setAll(name, value) {
    for (const material of this.materials) material.setParameter(name, value);
  }

  light(material, page) {
    if (this.materials.has(material)) return;
    this.materials.add(material);
    const textures = this.pages[page];
    material.lightMap = textures[0];  // makes PlayCanvas hand over the second UV set and call getLightMap()
    material.lightMapUv = UV_SET;
    material.getShaderChunks(pc.SHADERLANGUAGE_GLSL).set('lightmapPS', lightmapChunk(this.record, textures.length));
    textures.forEach((texture, k) => material.setParameter('rnmbakeLayer' + k, texture));
    material.setParameter('rnmbakeIntensity', 1);
    material.setParameter('rnmbakeFlat', 0);
    material.update();
  }
}

// What is in braces, PlayCanvas replaces: names and UVs of the material's own textures.
function lightmapChunk({ decoder, green }, count) {
  const layers = Array.from({ length: count }, (_, k) => k);
  return `uniform float rnmbakeIntensity;
uniform float rnmbakeFlat;
${layers.map((k) => `uniform sampler2D rnmbakeLayer${k};`).join('\n')}
${decoder.text}
// Unit normal in tangent space, as the maps have it.
vec3 rnmbakeNormal() {
  vec3 n = vec3(0.0, 0.0, 1.0);
  #ifdef STD_NORMAL_TEXTURE
    n = mix(n, {STD_NORMAL_TEXTURE_DECODE}(texture2DBias({STD_NORMAL_TEXTURE_NAME}, {STD_NORMAL_TEXTURE_UV}, {STD_TEXTURE_BIAS})), material_bumpiness);
  #endif
  n = normalize(mix(n, vec3(0.0, 0.0, 1.0), rnmbakeFlat));
  n.y *= ${green === 'y-down' ? '-1.0' : '1.0'};
  return n;
}
void getLightMap() {
  vec2 uv = {STD_LIGHT_TEXTURE_UV};
  vec3 light = ${decoder.function}(${layers.map((k) => `texture2D(rnmbakeLayer${k}, uv).rgb`).join(', ')}, rnmbakeNormal());
  dLightmap = rnmbakeIntensity * max(light, vec3(0.0));  // E/pi, which PlayCanvas multiplies by the albedo
}`;
}

async function loadPage(device, page, layers, base) {
  return Promise.all(layers.map(async (layer) => {
    const answer = await answerOf(new URL(page.layers[layer || 'flat'], base));
    const texels = new Uint16Array(await answer.arrayBuffer());
    return new pc.Texture(device, {
      name: page.layers[layer || 'flat'], width: page.width, height: page.height, format: pc.PIXELFORMAT_RGBA16F, levels: [texels],
      mipmaps: false, minFilter: pc.FILTER_LINEAR, magFilter: pc.FILTER_LINEAR, addressU: pc.ADDRESS_CLAMP_TO_EDGE,
      addressV: pc.ADDRESS_CLAMP_TO_EDGE,
    });
  }));
}

async function answerOf(url) {
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`${url}: ${answer.status} ${answer.statusText}`);
  return answer;
}

// `container`: the resource of the asset that PlayCanvas made of the scene.glb beside `url`.
export async function loadLightmaps(app, container, url) {
  if (app.graphicsDevice.isWebGPU) throw new Error('rnmbake_lightmaps.js needs a WebGL 2 device');
  const base = new URL(url, document.baseURI), record = await (await answerOf(base)).json();
  if (record.schema_version !== 1) throw new Error(`${url} is of another version of rnmbake`);
  const pages = await Promise.all(record.pages.map((page) => loadPage(app.graphicsDevice, page, record.decoder.layers, base)));
  const lightmaps = new Lightmaps(record, pages), meshes = container.data.gltf.meshes;
  for (const placed of record.objects)
    for (const { material } of meshes[placed.mesh].primitives)
      lightmaps.light(container.materials[material].resource, placed.page);
  return lightmaps;
}
