// SPDX-License-Identifier: MIT
import './style.css';
import './window';
import { render } from 'preact';
import { ReportSource, reportOf } from './data/report_source';
import { ServerSource } from './data/server_source';
import { App } from './panels/app';

const report = reportOf(document);
const source = report ? new ReportSource(report) : new ServerSource();
render(<App source={source} />, document.getElementById('app')!);
