// SPDX-License-Identifier: MIT
import { session } from '../state/session';
import './report_notes.css';

/** What whoever made the report has to say, and what the file does not hold; nothing if the page is no report. */
export function ReportNotes() {
  const report = session.value?.report;
  if (!report) return null;
  return (
    <section class="report-notes">
      <h2>{report.title}</h2>
      {report.notes.map((note) => (
        <p key={note}>{note}</p>
      ))}
      {report.leftOut.length > 0 && (
        <details>
          <summary>What this report leaves out</summary>
          <ul>
            {report.leftOut.map((sentence) => (
              <li key={sentence}>{sentence}</li>
            ))}
          </ul>
        </details>
      )}
      <p class="made">Made by strut {session.value?.version}.</p>
    </section>
  );
}
