// SPDX-License-Identifier: MIT
// The three-dimensional view: draws the stage at the moment of the clock, and only when something has changed.
import { effect } from '@preact/signals';
import * as THREE from 'three';
import { advance, isPlaying, time } from '../state/playback';
import {
  actors,
  alignments,
  followsRoot,
  layout,
  showsGrid,
  showsPlants,
  showsSlide,
  step,
  trails,
} from '../state/stage';
import { CameraRig } from './camera_rig';
import { Cast } from './cast';
import { drawing, drawingLevel, notePicture } from './drawing';
import { Floor } from './floor';
import { FrameCost } from './frame_cost';
import { Label } from './labels';
import { Picture } from './picture';
import { watchPointer } from './pointer';
import { readTheme, watchTheme } from './theme';
import {
  facesAlike,
  hoveredJoint,
  startsTogether,
  trailLength,
  type View,
  viewProblem,
  wantedTurn,
  wantedView,
} from './view_state';

/** How near a joint the pointer has to be [pixels]. */
const REACH = 16;

const NO_WEBGL = {
  message: 'This browser does not draw in three dimensions here: WebGL 2 is missing or switched off.',
  hint: 'Everything else on the page works. Switch on hardware acceleration in the settings of the browser, or open the address in another one.',
};
const LOST = {
  message: 'The graphics driver took the picture away.',
  hint: 'It comes back by itself as a rule. If it does not, load the page again: nothing that was saved is lost.',
};

function toggleTrail(name: string): void {
  const names = trails.peek();
  trails.value = names.includes(name) ? names.filter((entry) => entry !== name) : [...names, name];
}

class SceneView {
  private readonly scene = new THREE.Scene();
  private readonly picture: Picture;
  private readonly floor = new Floor();
  private readonly cast: Cast;
  private readonly rig: CameraRig;
  private readonly hover: Label;
  private readonly cost: FrameCost;
  private readonly sky = new THREE.HemisphereLight(0xffffff, 0xb8b2a8, 1.9);
  private readonly lamp = new THREE.DirectionalLight(0xffffff, 1.4);
  private readonly calm = matchMedia('(prefers-reduced-motion: reduce)');
  private readonly undo: (() => void)[] = [];
  private theme: ReturnType<typeof readTheme>;
  private size: [number, number] = [1, 1];
  private pointer: readonly [number, number] | null = null;
  /** What the picture was fitted to last. */
  private fitted = '';
  private shownActors = '';
  /** The picture that was asked for; 0: none. */
  private asked = 0;
  private goesOn = false;
  private before = 0;

  constructor(
    private readonly container: HTMLElement,
    private readonly stage: HTMLElement,
  ) {
    this.picture = new Picture(container, { lost: () => this.lose(), restored: () => this.restore() });
    const overlay = document.createElement('div');
    overlay.className = 'stage-labels';
    container.append(overlay);
    this.cast = new Cast(overlay);
    this.hover = new Label(overlay, 'joint-label');
    this.cost = new FrameCost(stage);
    this.rig = new CameraRig(container, this.request);
    this.theme = readTheme(container);
    this.rig.camera.add(this.lamp);
    this.lamp.position.set(-1.5, 1.5, 1);
    this.scene.add(this.rig.camera, this.sky, this.floor.object, this.cast.object);
    this.resize();
    this.listen();
    stage.dataset.state = 'ready';
  }

  private listen(): void {
    const resized = new ResizeObserver(() => this.resize());
    resized.observe(this.container);
    this.undo.push(
      () => resized.disconnect(),
      watchPointer(this.container, { moved: this.moved, clicked: this.clicked }),
      watchTheme(() => this.repaint()),
      effect(() => this.arrange()),
      effect(() => this.lookAsWanted()),
      effect(() => this.turnAsWanted()),
      effect(() => this.drawAsWanted()),
      effect(() => {
        // What a picture depends on besides what is arranged.
        void [time.value, isPlaying.value, step.value, alignments.value, trailLength.value];
        this.picture.moveShadows();
        this.request();
      }),
      followsRoot.subscribe((follows) => {
        if (follows && this.fitted !== '') this.recentre();
      }),
    );
  }

  /** Asks for a picture at the display's next frame. */
  private readonly request = (): void => {
    if (this.asked === 0) this.asked = requestAnimationFrame(this.draw);
  };

  /** Puts on the stage who belongs there, placed and coloured as the switches say. */
  private arrange(): void {
    this.cast.setActors(actors.value);
    this.cast.place({
      layout: layout.value,
      facesAlike: facesAlike.value,
      startsTogether: startsTogether.value,
    });
    this.picture.moveShadows();
    this.cast.trail(trails.value, this.theme);
    this.paint();
    this.fit();
    this.request();
  }

  private paint(): void {
    const isOverlaid = layout.value === 'overlaid';
    const isStacked = isOverlaid && startsTogether.value;
    this.cast.show(this.theme, { isOverlaid, isStacked, plants: showsPlants.value, slide: showsSlide.value });
    this.floor.paint(this.theme, showsGrid.value);
    this.sky.intensity = this.theme.isDark ? 1.5 : 1.9;
  }

  private repaint(): void {
    this.theme = readTheme(this.container);
    this.paint();
    this.request();
  }

  /** Looks at everybody anew when others, or in another order, are on the stage; stays with them when a clip changed. */
  private fit(): void {
    const key = [this.cast.views.length, layout.value, facesAlike.value, startsTogether.value].join();
    const shown = this.cast.views.map((view) => view.actor.clip.id).join();
    this.cast.update(time.peek(), trailLength.peek());
    this.rig.follow(this.cast.middle.x, this.cast.middle.z, shown !== this.shownActors);
    this.shownActors = shown;
    if (key === this.fitted || this.cast.views.length === 0) return;
    const isFirst = this.fitted === '';
    this.fitted = key;
    this.show(isFirst ? 'corner' : 'frame', isFirst);
  }

  private show(view: View, atOnce = false): void {
    const points = this.cast.points(followsRoot.peek());
    this.rig.show(view, points, this.cast.heading, !atOnce && !this.calm.matches);
    this.request();
  }

  /** Following begins where the bodies are, wherever one looked meanwhile. */
  private recentre(): void {
    this.rig.recentre(!this.calm.matches);
    this.request();
  }

  private lookAsWanted(): void {
    const wanted = wantedView.value;
    if (wanted) this.show(wanted.view);
  }

  private turnAsWanted(): void {
    const wanted = wantedTurn.value;
    if (!wanted) return;
    this.rig.turn(wanted, !this.calm.matches);
    this.request();
  }

  private drawAsWanted(): void {
    this.stage.dataset.drawing = String(drawingLevel.value);
    this.picture.draws(drawing.value);
    this.floor.draws(drawing.value);
    this.request();
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.container;
    if (width === 0 || height === 0) return;
    this.size = [width, height];
    this.picture.resize(width, height);
    this.rig.resize(width, height);
    // At once, as a canvas is blank when its size was set.
    this.draw(performance.now());
  }

  private readonly draw = (now: number): void => {
    // Also when called otherwise: one picture for each of the display's.
    cancelAnimationFrame(this.asked);
    this.asked = 0;
    const start = performance.now();
    const seconds = this.goesOn ? Math.max(0, now - this.before) / 1000 : 0;
    this.before = now;
    if (isPlaying.peek()) notePicture(seconds > 0 ? 1000 * seconds : null);
    if (seconds > 0) advance(seconds);
    const isMoving = this.update(seconds);
    const updated = performance.now();
    this.picture.draw(this.scene, this.rig.camera);
    this.cost.add(updated - start, performance.now() - start);
    this.goesOn = isPlaying.peek() || isMoving;
    if (this.goesOn) this.request();
  };

  /** Puts everything where it is now; true while the camera moves by itself. */
  private update(seconds: number): boolean {
    this.cast.update(time.peek(), trailLength.peek());
    this.rig.follow(this.cast.middle.x, this.cast.middle.z, followsRoot.peek());
    const isMoving = this.rig.update(seconds);
    this.floor.follow(this.cast.middle.x, this.cast.middle.z, this.cast.reach() + 1.6);
    this.rig.camera.updateMatrixWorld();
    for (const view of this.cast.views) view.updateLabel(this.rig.camera, ...this.size);
    if (this.pointer || hoveredJoint.peek()) this.showHovered();
    return isMoving;
  }

  private readonly moved = (at: readonly [number, number] | null): void => {
    this.pointer = at;
    this.request();
  };

  private readonly clicked = (at: readonly [number, number]): void => {
    const found = this.cast.pick(this.rig.camera, this.size, at, REACH);
    if (found) toggleTrail(found.name);
  };

  private showHovered(): void {
    const found = this.pointer && this.cast.pick(this.rig.camera, this.size, this.pointer, REACH);
    hoveredJoint.value = found?.name ?? null;
    this.container.style.cursor = found ? 'pointer' : '';
    if (!found) {
      this.hover.hide();
      return;
    }
    this.hover.text = found.name;
    this.hover.moveTo(found.x, found.y, found.z, this.rig.camera, ...this.size);
  }

  private lose(): void {
    viewProblem.value = LOST;
    this.stage.dataset.state = 'lost';
  }

  private restore(): void {
    viewProblem.value = null;
    this.stage.dataset.state = 'ready';
    this.request();
  }

  dispose(): void {
    for (const stop of this.undo) stop();
    cancelAnimationFrame(this.asked);
    this.cast.dispose();
    this.floor.dispose();
    this.rig.dispose();
    this.picture.dispose();
    this.container.replaceChildren();
  }
}

/** Draws into `container`, which is otherwise empty, until the returned function is called. How it goes is told by the
 *  data attributes of `stage`: state (ready, lost, missing), drawing (the level), framesDrawn, updateMs and frameMs. */
export function startScene(container: HTMLElement, stage: HTMLElement): () => void {
  let view: SceneView;
  try {
    view = new SceneView(container, stage);
  } catch {
    viewProblem.value = NO_WEBGL;
    stage.dataset.state = 'missing';
    return () => {};
  }
  return () => view.dispose();
}
