// SPDX-License-Identifier: MIT
import './style.css';
import { render } from 'preact';
import { ServerSource } from './data/server_source';
import { App } from './panels/app';
import * as playback from './state/playback';
import * as session from './state/session';
import * as stage from './state/stage';

// The page's state, for tests in a browser and for whoever is curious at its console.
Object.assign(window, { strut: { playback, session, stage } });
render(<App source={new ServerSource()} />, document.getElementById('app')!);
