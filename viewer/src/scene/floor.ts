// SPDX-License-Identifier: MIT
// The floor: a grid of 1 m with fine lines of 10 cm that reaches as far as one looks, and the shadow of what is over it.
import * as THREE from 'three';
import type { DrawingLevel } from './drawing_level';
import type { Theme } from './theme';

/** The side of the square in which the grid is drawn [m]; it has faded away before. */
const SIZE = 46;
const SHADOW_PIXELS = 1024;

const GRID_VERTEX = /* glsl */ `
  varying vec2 place;
  void main() {
    vec4 world = modelMatrix * vec4(position, 1.0);
    place = world.xz;
    gl_Position = projectionMatrix * viewMatrix * world;
  }`;

// Lines are as wide as a pixel at any distance, and fade before they are finer than pixels.
const GRID_FRAGMENT = /* glsl */ `
  uniform vec3 colour;
  uniform vec2 middle;
  varying vec2 place;
  float line(vec2 at, vec2 pixel, float width) {
    vec2 d = abs(fract(at - 0.5) - 0.5) / pixel;
    vec2 fade = 1.0 - smoothstep(0.12, 0.4, pixel);
    vec2 cover = (1.0 - smoothstep(width * 0.5, width * 0.5 + 1.0, d)) * fade;
    return max(cover.x, cover.y);
  }
  void main() {
    vec2 pixel = fwidth(place);
    float coarse = line(place, pixel, 0.3);
    float fine = line(place * 10.0, pixel * 10.0, 0.0);
    float far = length(place - middle);
    float ink = max(coarse * 0.62, fine * 0.26 * (1.0 - smoothstep(2.0, 7.0, far)));
    gl_FragColor = vec4(colour, ink * (1.0 - smoothstep(7.0, 22.0, far)));
    #include <colorspace_fragment>
  }`;

function plane(material: THREE.Material, size: number, order: number): THREE.Mesh {
  const mesh = new THREE.Mesh(new THREE.PlaneGeometry(size, size).rotateX(-Math.PI / 2), material);
  mesh.renderOrder = order;
  mesh.frustumCulled = false;
  return mesh;
}

function gridMaterial(): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({
    uniforms: { colour: { value: new THREE.Color() }, middle: { value: new THREE.Vector2() } },
    vertexShader: GRID_VERTEX,
    fragmentShader: GRID_FRAGMENT,
    transparent: true,
    depthWrite: false,
    side: THREE.DoubleSide,
  });
}

/** How far plain lines reach from the middle [m]. */
const PLAIN = 14;

/** Lines of 1 m that fade towards their ends, by colours of four numbers at their vertices. */
function plainLines(): THREE.LineSegments<THREE.BufferGeometry, THREE.LineBasicMaterial> {
  const places: number[] = [];
  const colours: number[] = [];
  for (let across = 1 - PLAIN; across < PLAIN; ++across) {
    const ink = 0.7 * (1 - Math.abs(across) / PLAIN);
    for (const along of [-PLAIN, PLAIN]) {
      places.push(across, 0, 0, across, 0, along, 0, 0, across, along, 0, across);
      for (const alpha of [ink, 0, ink, 0]) colours.push(1, 1, 1, alpha);
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.Float32BufferAttribute(places, 3));
  geometry.setAttribute('color', new THREE.Float32BufferAttribute(colours, 4));
  const material = new THREE.LineBasicMaterial({ vertexColors: true, transparent: true, depthWrite: false });
  const lines = new THREE.LineSegments(geometry, material);
  lines.frustumCulled = false;
  return lines;
}

/** Light almost from above, so that how far a shadow is from its foot tells the foot's height. */
function shadowLight(): THREE.DirectionalLight {
  const light = new THREE.DirectionalLight(0xffffff, 1.1);
  light.castShadow = true;
  light.shadow.mapSize.set(SHADOW_PIXELS, SHADOW_PIXELS);
  light.shadow.radius = 3;
  light.shadow.bias = -0.002;
  const { camera } = light.shadow;
  camera.near = 0.5;
  camera.far = 20;
  return light;
}

export class Floor {
  readonly object = new THREE.Group();
  private readonly grid = plane(gridMaterial(), SIZE, 0);
  private readonly plain = plainLines();
  private showsGrid = true;
  private isFine = true;
  private readonly shadow = plane(new THREE.ShadowMaterial({ opacity: 0.3, depthWrite: false }), 2, 4);
  private readonly light = shadowLight();

  constructor() {
    this.shadow.receiveShadow = true;
    this.object.add(this.grid, this.plain, this.shadow, this.light, this.light.target);
  }

  paint(theme: Theme, showsGrid: boolean): void {
    const { uniforms } = this.grid.material as THREE.ShaderMaterial;
    (uniforms.colour!.value as THREE.Color).copy(theme.soft).lerp(theme.page, 0.25);
    (this.shadow.material as THREE.ShadowMaterial).opacity = theme.isDark ? 0.55 : 0.28;
    this.plain.material.color.copy(theme.soft).lerp(theme.page, 0.25);
    this.showsGrid = showsGrid;
    this.choose();
  }

  /** Leaves out what the level leaves out. */
  draws({ shadows, fineGrid }: DrawingLevel): void {
    this.shadow.visible = shadows;
    this.light.castShadow = shadows;
    if (!shadows) {
      // It belongs to the canvas that drew it, which may go.
      this.light.shadow.map?.dispose();
      this.light.shadow.map = null;
    }
    this.isFine = fineGrid;
    this.choose();
  }

  private choose(): void {
    this.grid.visible = this.showsGrid && this.isFine;
    this.plain.visible = this.showsGrid && !this.isFine;
  }

  /** Keeps the floor about the middle of what is shown, and the shadows that fall `reach` metres to every side of it. */
  follow(x: number, z: number, reach: number): void {
    // The plane goes along; its lines do not, as they are drawn where they are in the world.
    this.grid.position.set(x, 0, z);
    this.plain.position.set(Math.round(x), 0, Math.round(z));
    this.shadow.position.set(x, 0, z);
    ((this.grid.material as THREE.ShaderMaterial).uniforms.middle!.value as THREE.Vector2).set(x, z);
    this.light.target.position.set(x, 0, z);
    this.light.position.set(x + 1.2, 9, z + 0.8);
    const { camera } = this.light.shadow;
    const wanted = Math.max(2, Math.ceil(reach));
    if (camera.right === wanted) return;
    this.shadow.scale.set(wanted, 1, wanted);
    camera.left = camera.bottom = -wanted;
    camera.right = camera.top = wanted;
    camera.updateProjectionMatrix();
  }

  dispose(): void {
    for (const mesh of [this.grid, this.plain, this.shadow]) {
      mesh.geometry.dispose();
      (mesh.material as THREE.Material).dispose();
    }
    this.light.dispose();
  }
}
