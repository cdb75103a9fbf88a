// A development tool: starts the stand-in. --project opens the project at once, --port N chooses a port,
// --crowd N adds so many nodes.
import { runnerImport } from 'vite';

const { module } = await runnerImport(new URL('./stand_in.ts', import.meta.url).pathname);
const value = (name) => process.argv[process.argv.indexOf(name) + 1];
const port = process.argv.includes('--port') ? Number(value('--port')) : 7357;
const crowd = process.argv.includes('--crowd') ? Number(value('--crowd')) : 0;
const started = await module.startStandIn({
  port,
  crowd,
  project: process.argv.includes('--project'),
});
console.log(`http://127.0.0.1:${started.port}/#token=dev`);
