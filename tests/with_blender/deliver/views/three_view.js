// Of the pages beside this file that are three.js's: what a camera sees, as coarser.js says.
import * as THREE from 'three';
import { FINER, coarser } from './coarser.js';

export function seenBy(renderer, scene, camera, width, height) {
  const columns = FINER * width, rows = FINER * height;
  const target = new THREE.WebGLRenderTarget(columns, rows, { type: THREE.FloatType });
  camera.aspect = width / height;
  camera.updateProjectionMatrix();
  renderer.setRenderTarget(target);
  renderer.render(scene, camera);
  const fine = new Float32Array(4 * columns * rows);
  renderer.readRenderTargetPixels(target, 0, 0, columns, rows, fine);
  return coarser(fine, width, height);
}
