// SPDX-License-Identifier: MIT
import './style.css';
import './window';
import { render } from 'preact';
import { ServerSource } from './data/server_source';
import { App } from './panels/app';

render(<App source={new ServerSource()} />, document.getElementById('app')!);
