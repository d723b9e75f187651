// SPDX-License-Identifier: MIT
// The page's state at the window, for tests in a browser and for whoever is curious at its console.
import * as playback from './state/playback';
import * as session from './state/session';
import * as stage from './state/stage';

const state = { playback, session, stage };

declare global {
  interface Window {
    strut: typeof state;
  }
}

window.strut = state;
