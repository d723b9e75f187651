// SPDX-License-Identifier: MIT
// The stage: the three-dimensional view and what stands over it.
import { useEffect, useRef } from 'preact/hooks';
import { startScene } from '../scene/scene';
import './stage.css';

export function Stage() {
  const place = useRef<HTMLDivElement>(null);
  useEffect(() => startScene(place.current!), []);
  return <div class="stage" ref={place} />;
}
