// SPDX-License-Identifier: MIT
// The stage: the three-dimensional view, and over it its toolbar, its legend, and why there is no picture.
import { useEffect, useRef } from 'preact/hooks';
import { startScene } from '../scene/scene';
import { viewProblem } from '../scene/view_state';
import { ProblemNote } from '../ui/problem_note';
import { StageLegend } from './stage_legend';
import { StageToolbar } from './stage_toolbar';
import './stage.css';

export function Stage() {
  const stage = useRef<HTMLElement>(null);
  const view = useRef<HTMLDivElement>(null);
  useEffect(() => startScene(view.current!, stage.current!), []);
  return (
    <section class="stage" ref={stage} aria-label="Stage">
      <div class="stage-view" ref={view} />
      {viewProblem.value && (
        <div class="stage-problem">
          <ProblemNote problem={viewProblem.value} />
        </div>
      )}
      <StageLegend />
      <StageToolbar />
    </section>
  );
}
