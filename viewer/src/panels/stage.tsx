// SPDX-License-Identifier: MIT
// The stage: the three-dimensional view, and over it its toolbar, its legend, and why there is no picture.
import { useEffect, useRef } from 'preact/hooks';
import { startScene } from '../scene/scene';
import { viewProblem } from '../scene/view_state';
import { ProblemNote } from '../ui/problem_note';
import { StageDrawing } from './stage_drawing';
import { StageLegend } from './stage_legend';
import { StageToolbar } from './stage_toolbar';
import './stage.css';

const LABEL =
  'The clips in three dimensions. Comma and period turn the camera, Shift and the arrows up and down tilt it, Z comes nearer, Shift Z goes farther.';

export function Stage() {
  const stage = useRef<HTMLElement>(null);
  const view = useRef<HTMLDivElement>(null);
  useEffect(() => startScene(view.current!, stage.current!), []);
  return (
    <section class="stage" ref={stage} aria-label="Stage">
      {/* biome-ignore lint/a11y/noNoninteractiveTabindex: who goes through the page by keys stops here and hears what they do. */}
      <div class="stage-view" ref={view} tabIndex={0} role="application" aria-label={LABEL} />
      {viewProblem.value && (
        <div class="stage-problem">
          <ProblemNote problem={viewProblem.value} />
        </div>
      )}
      <StageLegend />
      <StageToolbar />
      <StageDrawing />
    </section>
  );
}
