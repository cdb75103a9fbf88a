// Made from src/serve/protocol/protocol.json by scripts/protocol.mjs. Do not edit.

export type Json = null | boolean | number | string | Json[] | { [key: string]: Json };

export const format = 'vagus-protocol/1';
export const limits = {
  /** a text message from a client */
  message_bytes: 4194304,
  /** nesting of a message */
  message_depth: 32,
  /** pages at a time */
  clients: 64,
  /** connections that have shown no token, HTTP included; for another one that which is silent the longest makes room */
  strangers: 128,
  /** the same, of one address */
  strangers_of_address: 64,
  /** subscriptions of a page */
  watches: 256,
  /** commands of a page, averaged over two seconds */
  commands_a_second: 500,
  /** what waits for a page that reads slowly; documents and streams are merged below it */
  unsent_bytes: 8388608,
  /** an act is done so long after the key press at most */
  act_ms: 3000,
  /** from one ping of the server to the next */
  ping_ms: 1000,
  /** the first message of a client */
  hello_bytes: 4096,
  /** time for the first message */
  hello_ms: 5000,
  /** a page that stops reading for so long is disconnected */
  silent_ms: 10000,
  /** a text that is edited */
  document_bytes: 2097152,
  /** files of a project that are listed */
  files: 2000,
  /** happenings on the bus that can be asked for again */
  events_kept: 20000,
  /** lines of the console that can be asked for again */
  lines_kept: 5000,
  /** happenings of a fleet that can be asked for again */
  fleet_events_kept: 5000,
} as const;

/** A document: the path of a file inside the project, with / between folders. The script of a node in an .aesl file is PATH#N, N counting the nodes of the file from 1. */
export type Doc = string;

/** A path inside the project, with / between folders. */
export type Path = string;

/** The name of a node, variable, event or constant. */
export type Name = string;

/** The number of a node on the bus. */
export type NodeId = number;

/** Values of variables, arguments of events. */
export type Words = number[];

/** A place in a text. */
export interface Place {
  /** from 1 */
  line: number;
  /** from 1, in characters */
  column: number;
}

/** A change of a text. */
export interface Edit {
  doc: Doc;
  /** offset in UTF-16 units */
  from: number;
  /** the same, behind the last one that goes */
  to: number;
  /** what replaces it */
  text: string;
}

/** A change of the text at hand. Several changes of one message all count in the text before them and do not overlap. */
export interface Change {
  /** offset in UTF-16 units */
  from: number;
  /** the same, behind the last one that goes */
  to: number;
  /** what replaces it */
  text: string;
}

/** One step of a text. Versions count the steps, one by one. */
export interface Update {
  /** that it leads to */
  version: number;
  changes: Change[];
  /** as doc.edit named it; of what the server does: for:N for the client with that number, disk for a file that changed on disk, else server */
  by: string;
}

/** A text as a client has it. A command that changes several texts may name what its client has seen of them, and is refused (behind) if one of them is another by now. */
export interface DocVersion {
  doc: Doc;
  version: number;
  epoch?: string;
}

/** How a finding can be fixed. */
export interface Fix {
  /** what a button says: Write "==" */
  label: string;
  edits: Edit[];
}

/** A mistake or a remark. */
export interface Finding {
  doc: Doc;
  severity: 'error' | 'warning';
  /** name in the catalogue of the compiler, or rule of plans */
  code: string;
  /** actor, supervisor, variable */
  element?: string;
  at: Place;
  /** behind the last character that is meant */
  end: Place;
  /** one sentence */
  what: string;
  fixes: Fix[];
  /** in a plan: keys and indices that lead to what is meant */
  keys?: Json[];
}

/** Why a command was not done. */
export interface Problem {
  code: 'bad_message' | 'unknown_command' | 'not_allowed' | 'not_driver' | 'not_found' | 'bad_input' | 'conflict' | 'behind' | 'limit' | 'unavailable' | 'timeout' | 'failed' | 'late';
  /** a sentence for a person: what, where, what to do */
  what: string;
  /** the part of the message, or FILE:LINE:COLUMN */
  place?: string;
}

/** A file or folder of the project. */
export interface FileEntry {
  path: Path;
  kind: 'folder' | 'script' | 'plan' | 'world' | 'toolbox' | 'project' | 'picture' | 'text' | 'other';
  size: number;
  unsaved: boolean;
}

/** A target that can be chosen. */
export interface Found {
  /** for target.choose */
  target: string;
  name: string;
  kind: 'simulator' | 'serial' | 'local' | 'network';
  help: string;
}

/** An example that opens as a copy. */
export interface Example {
  id: string;
  name: string;
  help: string;
  robot: string;
  /** Plan, 6 actors */
  content: string;
}

/** What was opened before. */
export interface Recent {
  path: string;
  name: string;
  when_wall: number;
  there: boolean;
}

/** The script of one node. */
export interface ScriptPart {
  doc: Doc;
  name: Name;
  /** preferred node, 0: none */
  node: number;
  file: Path;
}

/** An event or a constant that all nodes of a file share. */
export interface Definition {
  name: Name;
  /** of a constant; number of arguments of an event */
  value: number;
}

/** A part of a script that runs by itself. */
export interface Handler {
  kind: 'init' | 'event' | 'sub';
  name: Name;
  line: number;
  words: number;
}

/** How much of a memory is used, in words. */
export interface Meter {
  used: number;
  of: number;
}

/** A breakpoint of a script. */
export interface Breakpoint {
  doc: Doc;
  line: number;
  condition: string;
  /** it stops after so many hits */
  ignore: number;
  enabled: boolean;
  hits: number;
  /** the node said so */
  set: boolean;
  /** why it is not set */
  why?: string;
}

/** A breakpoint of a plan. */
export interface PlanBreakpoint {
  /** handle for plan.break.set and plan.break.clear */
  number: number;
  doc: Doc;
  /** before the actor begins; when it has ended in the state; when the supervisor has raised the event; when a write makes the condition true */
  kind: 'actor' | 'state' | 'event' | 'condition';
  /** actor or supervisor; empty for a condition */
  element: string;
  /** state or event; empty: any */
  outcome: string;
  /** a formula that must hold, too */
  condition: string;
  /** it stops at this hit and at each after it */
  stop_at: number;
  enabled: boolean;
  /** of the run */
  hits: number;
  /** the plan runs with it */
  set: boolean;
  /** why it is not set, or why its condition cannot be evaluated */
  why?: string;
}

/** An event of the bus that waits while the plan is paused. */
export interface HeldEvent {
  /** handle for plan.held.go, plan.held.step and plan.held.drop */
  number: number;
  /** the time of the run's clock */
  t: number;
  /** seconds after the plan paused; 0 where the clock is paused with it */
  after: number;
  /** who emitted it; 0: a host */
  node: number;
  name: Name;
  args: Words;
}

/** A node of the target. */
export interface Node {
  id: NodeId;
  name: Name;
  /** name of its robot in the world; empty on a bus */
  robot: string;
  state: 'unknown' | 'running' | 'paused' | 'stopped' | 'gone';
  protocol: number;
  described: boolean;
  /** the script it gets */
  doc?: Doc;
  /** what is loaded, against the text */
  program: 'none' | 'unknown' | 'older' | 'current';
  /** when it was loaded */
  loaded_wall?: number;
  /** where it is paused */
  at?: Place;
  /** why it is paused; robot: it moves, and another node of the live robot is paused */
  why?: 'asked' | 'breakpoint' | 'step' | 'fault' | 'start' | 'robot';
  /** what came of Stop: read back as stopped, or not; missing once it may run again */
  stop?: 'asked' | 'stopped' | 'moving' | 'silent' | 'gone';
  /** what stopped it */
  fault?: string;
  /** what is under way */
  busy?: string;
  /** events for its script that were dropped since it paused at a line: a paused node drops them; missing while it runs, or if its script is not known */
  dropped?: number;
}

/** What came of Stop at a node. */
export interface StopNode {
  node: NodeId;
  /** empty if it has not told it */
  name: string;
  /** asked: it has answered, but not who it is; stopped: read back; moving: read back as not at rest yet; silent: it did not answer; gone: it was away before */
  state: 'asked' | 'stopped' | 'moving' | 'silent' | 'gone';
}

/** A connection of the bus. */
export interface Link {
  name: string;
  nodes: NodeId[];
  frames_in: number;
  frames_out: number;
  lost: number;
}

/** Who says what to whom. */
export interface Traffic {
  /** 0: a host */
  from: number;
  event: Name;
  count: number;
  /** nodes whose scripts have a handler for it; 0: a host, its plan hears it */
  to: number[];
}

/** A variable of a node. */
export interface Variable {
  name: Name;
  address: number;
  size: number;
  of: 'node' | 'script';
  unit?: string;
  help?: string;
  writable: boolean;
}

/** A native function of a node. */
export interface Native {
  name: Name;
  help: string;
  parameters: Parameter[];
}

/** A parameter of a native function. */
export interface Parameter {
  name: Name;
  /** words; below 0: as many as the others of that number */
  size: number;
}

/** An event that comes from the node's own hardware. */
export interface LocalEvent {
  name: Name;
  help: string;
}

/** Something that happened on the bus or in the plan. */
export interface Happening {
  /** counts up */
  number: number;
  /** the one of the topic history; missing in what history.at gives */
  run?: number;
  /** seconds since the run began; on a bus without one, since it was connected */
  t: number;
  /** 0: not known, it is of a run that was run again */
  wall: number;
  kind: 'event' | 'state' | 'fault' | 'appeared' | 'gone' | 'loaded' | 'plan' | 'lost';
  node: number;
  source: string;
  name: string;
  args: Words;
  text: string;
}

/** Something that lasted, on a timeline. */
export interface HistoryBar {
  from: number;
  /** missing: it goes on */
  to?: number;
  name?: string;
  /** how it ended: a state, or interrupted */
  end?: string;
  /** of those that are drawn as this one */
  count?: number;
}

/** Something that happened, on a timeline. */
export interface HistoryMark {
  t: number;
  name?: string;
  /** where an event led */
  to?: string;
  count?: number;
}

/** A row of a timeline. */
export interface HistoryLane {
  kind: 'actors' | 'supervisor' | 'events';
  /** instance path of the plan; empty for events */
  path: string;
  /** of the supervisor, of the source of events */
  name: string;
  bars: HistoryBar[];
  marks: HistoryMark[];
}

/** A word over time. */
export interface HistoryCurve {
  node: number;
  /** missing: the load that the node puts on the bus, in hundredths of a percent */
  address?: number;
  /** the lowest value of each column of equal time, null where it is not recorded */
  low?: Json;
  /** the highest */
  high: Json;
}

/** Words of a node as they were. */
export interface HistoryWords {
  node: NodeId;
  address: number;
  /** null: not recorded */
  words: Json[];
}

/** What a node did, and where it was paused. */
export interface HistoryNode {
  node: NodeId;
  state: string;
  line?: number;
}

/** A happening, and after it what it followed from. */
export interface WhyLink {
  t: number;
  /** a sentence without its full stop */
  what: string;
  /** what it wrote or carried; empty: nothing */
  value: string;
  /** FILE:LINE as the recording names it; empty: nowhere */
  place: string;
  /** the document of the project that this is; missing: it has none */
  doc?: Doc;
  /** there */
  line?: number;
  /** of the plan */
  element?: string;
  /** nothing in the run came before it */
  root: boolean;
}

/** How far the search for a turning point is. */
export interface TurningProgress {
  /** the run as it was; continuations from instants over all of it; from those in between; two of them are recorded */
  stage: 'run' | 'curve' | 'narrowing' | 'recordings';
  /** continuations */
  done: number;
  of: number;
}

/** An instant from which a run was continued with other seeds. */
export interface TurningPoint {
  t: number;
  /** continuations from there in which the condition became true */
  came: number;
  /** of so many */
  of: number;
  /** of the chance that this says, with 95 % confidence */
  low: number;
  high: number;
  /** nothing was continued there: all is known */
  end: boolean;
}

/** Where it turned whether a condition becomes true. */
export interface Turn {
  /** the last instant at which it was open */
  before: TurningPoint;
  /** the first at which it was not */
  after: TurningPoint;
  /** they are a millisecond apart; else it changed little by little in between */
  narrowed: boolean;
  /** the recording of a continuation in which it became true; missing: there was none */
  with?: Path;
  /** of one in which it did not */
  without?: Path;
  /** what there was where it turned */
  there: WhyLink[];
}

/** When it was decided whether a condition becomes true. */
export interface Turning {
  sentence: string;
  /** when it became true in the run itself; missing: it did not */
  came?: number;
  /** until then the run was looked at */
  end: number;
  /** in all */
  continuations: number;
  /** by time */
  curve: TurningPoint[];
  /** missing: chance did not decide it */
  turn?: Turn;
}

/** One thing of two runs, followed until they differ. */
export interface ComparedLane {
  /** a channel of the recordings; /world/poses and a robot or object; end */
  name: string;
  /** values */
  compared: number;
  /** of the first difference, from where the two are aligned; missing: there is none */
  t?: number;
  /** in what was recorded: set.token; empty: all of it */
  place?: string;
  /** as JSON; empty: nothing was there */
  a?: string;
  b?: string;
}

/** What one of two runs is drawn from. Times are those of that run. */
export interface ComparedRun {
  /** of its recording */
  path: string;
  /** the instant at which it is aligned */
  start: number;
  end: number;
  /** it has ended */
  complete: boolean;
  actors: ComparedActor[];
  /** that supervisors raised */
  events: ComparedEvent[];
  ways: ComparedWay[];
  /** actors and events that are left out */
  more: number;
}

/** An actor while it was active. */
export interface ComparedActor {
  name: string;
  /** 0: of the outermost plan */
  level: number;
  from: number;
  to: number;
}

/** An event that a supervisor raised. */
export interface ComparedEvent {
  name: string;
  supervisor: string;
  t: number;
}

/** Where a robot went. */
export interface ComparedWay {
  robot: string;
  length: number;
  /** of its hull */
  width: number;
  /** t, x, y, angle of each */
  points: number[];
}

/** A thing in the world, from above. */
export interface ComparedShape {
  round: boolean;
  at: Point;
  angle: number;
  /** of a disc its diameter */
  size: number[];
}

/** What two runs were started with that is not the same. */
export interface StartedApart {
  what: string;
  /** as JSON; of a file its bytes; empty: there is none */
  a: string;
  b: string;
}

/** What a log point found when it was reached. */
export interface LogHit {
  t: number;
  /** NODE:LINE of the file, with the robot before it where there are several; empty: of the plan */
  where: string;
  /** in the order of the names; an array as [1, 2, 3] */
  values: string[];
}

/** A test of behaviour, as it is run. */
export interface TestRun {
  path: Path;
  /** one for each seed */
  runs: number;
  done: number;
  /** of those that are done */
  failed: number;
  /** why it cannot be run */
  why?: string;
  /** of that in it */
  at?: Place;
  failures: TestFailure[];
}

/** What was not as expected in one run of a test. */
export interface TestFailure {
  seed: number;
  /** when it was known; missing: the run crashed */
  t?: number;
  /** of the expectation in the test */
  at?: Place;
  expected?: string;
  /** the values then, or how it crashed */
  what: string;
  /** of the test */
  help?: string;
  /** recording.open takes it, until tests are run again */
  recording?: Path;
}

/** How much of a file was taken. */
export interface CoverageRow {
  /** a plan or a file of scripts */
  path: Path;
  kinds: CoverageShare[];
}

/** How many of a kind were ever taken. */
export interface CoverageShare {
  name: 'actors' | 'states' | 'supervisors' | 'events' | 'pairs' | 'lines' | 'branches';
  taken: number;
  of: number;
}

/** How often each was taken; what never was is there with 0. */
export interface PlanCoverage {
  /** by name */
  actors: Record<string, number>;
  /** "followWall: WallLost" */
  states: Record<string, number>;
  /** "touch"; of an actor: "followWall.wallTouch" */
  supervisors: Record<string, number>;
  /** "touch: TouchSensorPressed" */
  events: Record<string, number>;
  /** "searchFirstWall, findWallAngle" */
  pairs: Record<string, number>;
}

/** A line of a script that is code. */
export interface LineCoverage {
  line: number;
  /** how often its busiest instruction was executed */
  count: number;
  /** of its branches */
  ways?: number;
  /** of these ways */
  taken?: number;
}

/** A line of the console. */
export interface Line {
  number: number;
  t: number;
  kind: 'note' | 'warning' | 'error' | 'log';
  text: string;
}

/** Something that may be written at the cursor. */
export interface Suggestion {
  label: string;
  kind: 'variable' | 'constant' | 'event' | 'native' | 'sub' | 'keyword' | 'function' | 'actor' | 'supervisor' | 'template' | 'value';
  detail: string;
  help: string;
  insert: string;
}

/** A place in a document, with its line. */
export interface Spot {
  doc: Doc;
  at: Place;
  end: Place;
  line_text: string;
}

/** A robot of the world. */
export interface Robot {
  name: string;
  type: 'thymio2' | 'epuck' | 'carbot';
  nodes: NodeId[];
  /** in the frame of the robot */
  outline: Point[];
  paint: Colour;
  /** of its body, in m */
  height: number;
  camera: boolean;
  /** what world.press takes */
  buttons: string[];
}

/** x and y in metres; x right, y up. */
export type Point = number[];

/** Red, green, blue, 0 to 1. */
export type Colour = number[];

/** An object of the world. */
export interface SceneObject {
  /** empty if the file gives none */
  id: string;
  /** handle for world commands, never used twice */
  number: number;
  kind: 'wall' | 'box' | 'cylinder' | 'patch' | 'light' | 'infrared';
  /** width, height in m */
  size?: number[];
  radius?: number;
  height: number;
  mass: number;
  colour: Colour;
  on: boolean;
}

/** An input of a template of plans. */
export interface PlanInput {
  name: Name;
  type: 'any' | 'bool' | 'int' | 'float' | 'string' | 'object';
  unit: string;
  help: string;
  /** without it the input needs a value */
  default?: Json;
  low?: number;
  high?: number;
}

/** An output of a template of plans. */
export interface PlanOutput {
  name: Name;
  type: 'any' | 'bool' | 'int' | 'float' | 'string' | 'object';
  unit: string;
  help: string;
}

/** A state of an actor, an event of a supervisor. */
export interface PlanOutcome {
  name: Name;
  help: string;
}

/** What an actor or supervisor of a plan is an instance of. */
export interface PlanTemplate {
  name: Name;
  kind: 'actor' | 'computation' | 'supervisor';
  help: string;
  /** SVG path data on a 24 x 24 field */
  icon: string;
  inputs: PlanInput[];
  outputs: PlanOutput[];
  outcomes: PlanOutcome[];
  /** of a supervisor; 0: it waits for its event */
  period_ms: number;
  /** events that begin its work on nodes */
  starts: Name[];
}

/** Templates for one platform. */
export interface PlanToolbox {
  name: Name;
  help: string;
  templates: PlanTemplate[];
}

/** A variable of a plan that runs. */
export interface PlanVariable {
  name: Name;
  type: 'bool' | 'int' | 'float' | 'string' | 'object';
  value: Json;
  unit: string;
}

/** A value for a variable of a plan that runs. */
export interface PlanSetting {
  /** 0: the outermost plan */
  level: number;
  name: Name;
  value: Json;
}

/** A supervisor of a plan that runs. */
export interface PlanSupervisor {
  name: Name;
  global: boolean;
  watching: boolean;
  events: Name[];
}

/** How often an element of a plan had its turn in this run, and how long it took. */
export interface PlanCount {
  is: 'actor' | 'supervisor';
  name: Name;
  /** an actor has begun, a supervisor has raised an event */
  times: number;
  /** all in all, of the activations that are over */
  seconds: number;
  /** of the last one that is over */
  last: number;
}

/** The arrow that a plan took last. */
export interface PlanTaken {
  /** counts up through all plans of the run */
  number: number;
  is: 'start' | 'state' | 'event';
  /** actor or supervisor; empty of the start */
  element: string;
  /** state or event */
  outcome: string;
  target: string;
}

/** A plan that runs, with its active actor; the outermost first. */
export interface PlanLevel {
  /** instance path: WallFollow/calibrate */
  path: string;
  doc: Doc;
  actor: string;
  template: string;
  activation: number;
  since: number;
  inputs: Json;
  variables: PlanVariable[];
  supervisors: PlanSupervisor[];
  counts: PlanCount[];
  taken?: PlanTaken;
}

/** What somebody who tries a plan has chosen. */
export interface TryChoice {
  /** of the plan: WallFollow/calibrate */
  path: string;
  /** the actor that ends, or the supervisor that raises */
  element: string;
  /** its state, or its event */
  outcome: string;
  /** of an actor; those that are missing write nothing */
  out?: TryValue[];
}

/** An output of an actor in a plan that is tried. */
export interface TryValue {
  name: string;
  /** a number, true, false or a text */
  value: Json;
}

/** An output that can be chosen. */
export interface TryOutput {
  name: string;
  /** missing: any */
  type?: 'bool' | 'int' | 'float' | 'string' | 'object';
}

/** The active actor of a plan that is tried. */
export interface TryWait {
  path: string;
  actor: string;
  /** in which it can end */
  states: string[];
  outputs: TryOutput[];
}

/** A supervisor that watches in a plan that is tried. */
export interface TryRaise {
  path: string;
  supervisor: string;
  events: string[];
}

/** What an actor did in a plan that is tried; computations are left out. */
export interface TryTurn {
  path: string;
  actor: string;
  from: number;
  /** missing: it is active */
  to?: number;
  /** the state in which it ended, or SUPERVISOR.EVENT */
  end?: string;
  /** by an event */
  interrupted?: boolean;
}

/** A plan that is tried, as the topic plan shows one that runs. */
export interface TriedPlan {
  state: 'none' | 'running' | 'paused' | 'ended';
  doc?: Doc;
  t: number;
  result?: 'OK' | 'Interrupted' | 'Error';
  message?: string;
  levels: PlanLevel[];
  story: Line[];
}

/** What differs between two versions of a plan, as vagus plan diff --json says it. */
export interface PlanDifference {
  kind: 'added' | 'removed' | 'changed' | 'reordered';
  /** actor drive, supervisor touch of drive, plan */
  element: string;
  /** in.speed; empty: the element itself */
  part: string;
  /** keys of the plan file that lead to it; of what is reordered, to the list */
  path: string[];
  /** not if added; of what is reordered, the names in their order */
  before?: Json;
  /** not if removed */
  after?: Json;
  /** if added: the key in front of it; empty: it is the first */
  behind?: string;
}

/** A commit that changed a file. */
export interface GitVersion {
  revision: string;
  /** of the commit */
  when_wall: number;
  /** its author */
  by: string;
  subject: string;
}

/** The recording of a run before. */
export interface KeptRecording {
  path: Path;
  /** of the run */
  number: number;
  bytes: number;
  /** when the last of it was written */
  when_wall: number;
}

/** A new version of the plan that runs (P31). */
export interface PlanChange {
  /** counts up */
  number: number;
  t: number;
  state: 'taken' | 'refused';
  /** what was saved */
  docs: Doc[];
  /** why it was refused */
  reasons: string[];
}

/** Lines of generated code that belong to an element; one element may have several. */
export interface CodeMark {
  /** that lead to an element of the plan: actors, followWall */
  keys: string[];
  /** line */
  first: number;
  last: number;
}

/** A word of formulas. */
export interface FormulaWord {
  /** as it is written */
  name: string;
  is: 'function' | 'operator' | 'constant';
  /** clamp(x, low, high) */
  form: string;
  help: string;
}

/** A change of one value of a JSON file. */
export interface JsonStep {
  do: 'set' | 'remove' | 'insert' | 'move';
  /** keys and indices that lead to the value; the last one is the key or index meant, insert puts the value before that index */
  at: Json[];
  /** for set and insert */
  value?: Json;
  /** instead of value: its JSON text, whose keys keep their order */
  text?: string;
  /** for move: the new index */
  to?: number;
}

/** The open project. */
export interface Project {
  folder: string;
  name: string;
  help: string;
  /** opened without a vagus.json: project.make gives it one */
  bare?: boolean;
  /** example it is a copy of */
  copy_of?: string;
  /** it was made of this recording, and nothing has run since: to be shown first */
  recording?: Path;
  plan?: Path;
  world?: Path;
  /** the text of the world, or the picture on its ground, is another one than when it was opened */
  world_changed?: boolean;
  scripts: Path[];
  target: string;
  /** the outermost folder of the project; paths count from it */
  border?: string;
}

/** Something in a folder of this computer. */
export interface FolderEntry {
  name: string;
  kind: 'folder' | 'project' | 'script' | 'plan' | 'world' | 'recording';
}

/** What all nodes of an .aesl file share. */
export interface SharedFile {
  path: Path;
  events: Definition[];
  constants: Definition[];
}

/** An instruction of a script. */
export interface ListingLine {
  /** 0: no line of the text */
  line: number;
  address: number;
  words: number;
  text: string;
}

/** A node that did not do it. */
export interface Failed {
  node: NodeId;
  why: string;
}

/** What a node answered. */
export interface NodeNote {
  node: NodeId;
  what: string;
}

/** How a run ended, and which nodes stopped. */
export interface RunEnd {
  number: number;
  /** the clock of the run */
  t: number;
  wall: number;
  /** a page's name, a signal, the plan, the server */
  by: string;
  why: 'stop' | 'plan' | 'error' | 'died' | 'signal' | 'target' | 'project' | 'version' | 'alone' | 'slept';
  /** of the plan */
  result?: 'OK' | 'Interrupted' | 'Error';
  /** why it is an error */
  message?: string;
  nodes: StopNode[];
}

/** A file of a project that is sent to a robot. */
export interface DeployFile {
  /** from the border of the project */
  path: Path;
  size: number;
  /** in hexadecimal digits */
  sha256: string;
}

/** A version of the project on a robot. */
export interface Deployed {
  /** 0: the folder as it was given */
  version: number;
  name: string;
  /** when it came */
  when_wall?: number;
  /** in force */
  current: boolean;
}

/** A robot of a fleet, as it told it. */
export interface FleetRobot {
  /** offline: it said so; lost: the broker missed it */
  connection: 'online' | 'offline' | 'lost' | 'unknown';
  /** of its state: waiting: it has not told it since the broker was reached; stale: it has told nothing for 6 s, or the broker is gone */
  age: 'fresh' | 'waiting' | 'stale';
  /** missing: it never told it */
  state?: 'running' | 'paused' | 'stopped' | 'fault';
  /** what its plan does */
  actor?: string;
  /** since when, by the server's clock */
  since_wall?: number;
  /** of a stale one: when it told its state last */
  told_wall?: number;
  problems?: string[];
  /** events that were too many, too old, or did not fit */
  left_out?: number;
  project?: string;
  /** version of Vagus */
  vagus?: string;
  /** file of its plan */
  plan?: string;
  groups?: string[];
  nodes?: string[];
  /** events that it hears */
  hear?: string[];
  /** address of its own studio, http: or https: */
  studio?: string;
}

/** What became of an order at a robot. */
export interface FleetOutcome {
  robot: string;
  /** silent: it is online and did not answer; away: it is not online */
  result: 'done' | 'refused' | 'silent' | 'away';
  /** why it was not done */
  what: string;
}

/** What became of a robot in a roll-out. */
export interface RolloutRobot {
  /** its place in the order */
  at: number;
  /** later: it is as it was */
  is: 'later' | 'wanted' | 'started' | 'well' | 'failed';
  /** of failed; of started what the project's own condition lacks */
  why: string;
  /** the version is in force there */
  has: boolean;
}

/** Something that happened in a fleet. */
export interface FleetEvent {
  /** counts up */
  number: number;
  wall: number;
  /** order: what a page of this studio told robots */
  kind: 'event' | 'connection' | 'order';
  /** of an order: the page that gave it */
  robot: string;
  /** of the event; online, offline, lost; the order */
  name: string;
  args: Words;
  text: string;
}

/** Someone who requests control. */
export interface Asked {
  client: number;
  name: string;
  until_wall: number;
}

export interface Commands {
  /** The first message: who the client is. The token comes from the fragment of the printed address. */
  'hello': { in: {
    token: string;
    /** made once by the client, kept over reconnections */
    client: string;
    /** what others see */
    name?: string;
    /** made by each page load: one client with two nonces is two pages */
    nonce?: string;
    /** when it lost its connection; after a restart it has control again, not the page that connects first */
    had_control?: boolean;
  }; out: {
    version: string;
    /** random, of the server's life */
    epoch: string;
    /** its name from now on: another one if two pages have the same */
    client: string;
    /** the server's time in ms, for until */
    now: number;
    role: 'drive' | 'look';
    /** of this client */
    number: number;
    /** has control */
    driver: boolean;
    wall: number;
    /** how often others have pressed Stop */
    stops?: number;
  } };
  /** Subscribes to a topic. */
  'watch': { in: {
    /** number chosen by the client */
    watch: number;
    topic: string;
    /** what the topic's of asks for */
    of?: Json;
    /** at most so many times a second (20) */
    rate?: number;
  }; out: Record<never, never> };
  /** Ends a subscription. */
  'unwatch': { in: {
    watch: number;
  }; out: Record<never, never> };
  /** Stops the robot, from any page: ends the plan, sends Stop to every node, brings the wheels to rest. */
  'stop': { in: Record<never, never>; out: {
    /** nodes that were read back as stopped */
    stood: NodeId[];
    nodes: StopNode[];
  } };
  /** Somebody knows of the nodes that did not answer when the run ended: they are asked no more. */
  'end.acknowledge': { in: {
    /** of the end */
    number: number;
  }; out: Record<never, never> };
  /** Requests control. At once if nobody has it or the driver's page is closed; else the driver is asked, and 10 s without an answer refuse it. */
  'driver.ask': { in: Record<never, never>; out: {
    driver: boolean;
  } };
  /** Gives control to the one who requested it, or keeps it. */
  'driver.answer': { in: {
    give: boolean;
  }; out: Record<never, never> };
  /** Makes a new token of those who drive, in the place of the old one, and disconnects all others who used that. */
  'access.renew': { in: Record<never, never>; out: {
    /** the new one */
    token: string;
  } };
  /** Releases control. */
  'driver.leave': { in: Record<never, never>; out: Record<never, never> };
  /** A robot that serves itself: announces another version of its project. */
  'deploy.begin': { in: {
    name: string;
    /** the folder of its vagus.json, from the border of the project; empty: the border itself */
    project: string;
    files: DeployFile[];
  }; out: Record<never, never> };
  /** Bytes of an announced file; the files in their order, each from its first byte to its last, an empty one by one empty part. */
  'deploy.part': { in: {
    path: Path;
    from: number;
    base64: string;
  }; out: Record<never, never> };
  /** Checks what came, stops the run, puts the version in force and starts it. The version before is in force again if it does not start within 10 s. */
  'deploy.commit': { in: Record<never, never>; out: {
    /** stopped: somebody pressed Stop before it ran; waiting: it is in force and does not start yet */
    result: 'started' | 'stopped' | 'refused' | 'rolled_back' | 'waiting';
    /** that is in force now */
    version: number;
    findings: Finding[];
    why?: string;
  } };
  /** The version before is in force again, and started. */
  'deploy.back': { in: Record<never, never>; out: {
    /** stopped: somebody pressed Stop before it ran; waiting: it is in force and does not start yet */
    result: 'started' | 'stopped' | 'refused' | 'rolled_back' | 'waiting';
    /** that is in force now */
    version: number;
    findings: Finding[];
    why?: string;
  } };
  /** Versions that are kept. */
  'deploy.list': { in: Record<never, never>; out: {
    versions: Deployed[];
  } };
  /** Copies an example into the user's folder and opens it. */
  'project.example': { in: {
    id: string;
  }; out: {
    path: string;
  } };
  /** Opens a folder with a vagus.json, or with scripts, plans or worlds, or one such file alone. */
  'project.open': { in: {
    path: string;
  }; out: {
    path: string;
  } };
  /** Makes a project in the user's folder and opens it. */
  'project.new': { in: {
    name: string;
    robot: 'thymio2' | 'carbot' | 'epuck';
    /** with a small plan to begin with; a carbot always has a plan, a nearly empty one without this */
    plan: boolean;
  }; out: {
    path: string;
  } };
  /** Makes the folder of what is open without a vagus.json a project, with a world to run in, and opens it. */
  'project.make': { in: {
    /** that is looked at: in a folder of several it is what runs */
    doc?: Doc;
  }; out: {
    path: string;
  } };
  /** Back to the start screen. The run ends. */
  'project.close': { in: Record<never, never>; out: Record<never, never> };
  /** Takes an entry from the recent ones. */
  'project.forget': { in: {
    path: string;
  }; out: Record<never, never> };
  /** Folders and openable files of a folder of this computer, for choosing one. */
  'folder.list': { in: {
    /** empty: the home folder */
    path: string;
  }; out: {
    path: string;
    parent: string;
    entries: FolderEntry[];
  } };
  /** Makes a file from a template, or a folder. */
  'file.new': { in: {
    path: Path;
    kind: 'folder' | 'script' | 'plan' | 'world' | 'toolbox' | 'text';
  }; out: Record<never, never> };
  /** Renames or moves a file or folder inside the project; vagus.json and files that name it follow. */
  'file.rename': { in: {
    path: Path;
    to: Path;
    seen?: DocVersion[];
  }; out: {
    followed: Path[];
  } };
  /** Moves a file or folder to .vagus/trash. */
  'file.delete': { in: {
    path: Path;
  }; out: Record<never, never> };
  /** A file as it is saved, for export and pictures, base64. */
  'file.bytes': { in: {
    path: Path;
  }; out: {
    base64: string;
  } };
  /** The text of a document as it is now, saved or not. Each line ends with one line feed, whatever its file has there, and counts one; the file keeps what it has. */
  'doc.open': { in: {
    doc: Doc;
  }; out: {
    /** of the server's life, in which versions count */
    epoch: string;
    text: string;
    version: number;
    language: 'aesl' | 'aesl-file' | 'plan' | 'world' | 'toolbox' | 'json' | 'text';
    unsaved: boolean;
    /** of the file's lines */
    ends: 'lf' | 'crlf' | 'mixed';
  } };
  /** Changes a text. It is in the journal before it is answered. It is done if the answer has neither behind nor text; else nothing was done: the client makes its changes fit the text that there is, and sends them again. */
  'doc.edit': { in: {
    doc: Doc;
    epoch: string;
    /** the text that the changes count in */
    version: number;
    /** the client's name for itself, the same in each of its edits */
    by: string;
    changes: Change[];
  }; out: {
    /** that there is now */
    version: number;
    /** the steps that the client lacks */
    behind?: Update[];
    /** all of it, where the steps are not kept or the epoch is another */
    text?: string;
    /** with text */
    epoch?: string;
  } };
  /** The steps that lead from a version to the text that there is, or its whole text. */
  'doc.pull': { in: {
    doc: Doc;
    epoch: string;
    version: number;
  }; out: {
    version: number;
    behind?: Update[];
    text?: string;
    /** with text */
    epoch?: string;
  } };
  /** What the file has on disk, while that is another text than the one that unsaved changes began as. */
  'doc.disk': { in: {
    doc: Doc;
  }; out: {
    text: string;
  } };
  /** Changes a JSON file by its members; the rest keeps its form. Refused (behind) if the text is another by now. */
  'doc.patch': { in: {
    doc: Doc;
    epoch?: string;
    version: number;
    steps: JsonStep[];
  }; out: {
    version: number;
    text: string;
  } };
  /** Replaces the file by the text. Saving what was not changed changes no byte. What somebody else wrote into the file meanwhile is put together with it where both changed other lines; else it is refused (conflict) until doc.keep or doc.revert. */
  'doc.save': { in: {
    doc: Doc;
  }; out: {
    /** that is on disk */
    version: number;
  } };
  /** Saves all that is unsaved. Refused (conflict) if a file changed on disk where its text has unsaved changes; the others are saved. */
  'doc.save_all': { in: Record<never, never>; out: {
    saved: Path[];
  } };
  /** Back to the file as it is on disk. */
  'doc.revert': { in: {
    doc: Doc;
    seen?: DocVersion[];
  }; out: {
    version: number;
  } };
  /** The file changed on disk where its text has unsaved changes: keeps the text (mine), which can be saved then, takes the file (disk), or keeps both, mine in front of the file's where both changed one line. Refused (behind) if the file is another one than disk_hash names: nobody has seen it. */
  'doc.keep': { in: {
    doc: Doc;
    which: 'mine' | 'disk' | 'both';
    /** of the topic doc; missing: there is no conflict */
    disk_hash?: string;
    seen?: DocVersion[];
  }; out: {
    version: number;
  } };
  /** What may be written at a place. */
  'script.complete': { in: {
    doc: Doc;
    at: Place;
  }; out: {
    /** where the word begins that is replaced */
    from: Place;
    items: Suggestion[];
  } };
  /** What is at a place. */
  'script.hover': { in: {
    doc: Doc;
    at: Place;
  }; out: {
    found: boolean;
    at?: Place;
    end?: Place;
    title?: string;
    help?: string;
  } };
  /** Where the name at a place is declared. */
  'script.definition': { in: {
    doc: Doc;
    at: Place;
  }; out: {
    spots: Spot[];
  } };
  /** Where the name at a place is used, in all scripts that share it. */
  'script.references': { in: {
    doc: Doc;
    at: Place;
  }; out: {
    name: string;
    spots: Spot[];
  } };
  /** Renames a variable, constant, event, sub in all scripts that share it; an event also in the project's plans and toolboxes. */
  'script.rename': { in: {
    doc: Doc;
    at: Place;
    to: Name;
    seen?: DocVersion[];
  }; out: {
    changed: Doc[];
    places: number;
  } };
  /** Bytecode beside its lines. */
  'script.listing': { in: {
    doc: Doc;
  }; out: {
    lines: ListingLine[];
  } };
  /** Begins a script for a node that has none, in the first .aesl file of the project. */
  'script.add': { in: {
    node: NodeId;
  }; out: {
    doc: Doc;
  } };
  /** Where scripts handle one of these events, at the name of the event; in the order of the events. */
  'script.handlers': { in: {
    events: Name[];
  }; out: {
    spots: Spot[];
  } };
  /** Whether a text can be the name of something in a script. */
  'script.format_name': { in: {
    name: string;
  }; out: {
    good: boolean;
    why?: string;
  } };
  /** Searches all texts of the project. */
  'text.search': { in: {
    text: string;
    regex: boolean;
    case: boolean;
    whole: boolean;
  }; out: {
    spots: Spot[];
    more: boolean;
    /** what is wrong with the expression */
    why?: string;
  } };
  /** Replaces what text.search found. */
  'text.replace': { in: {
    text: string;
    regex: boolean;
    case: boolean;
    whole: boolean;
    by: string;
    /** only in these */
    docs?: Doc[];
    seen?: DocVersion[];
  }; out: {
    changed: Doc[];
    places: number;
  } };
  /** What would be wrong with a plan after some steps. Nothing is changed. */
  'plan.check': { in: {
    doc: Doc;
    steps: JsonStep[];
  }; out: {
    findings: Finding[];
  } };
  /** The C++ program of a plan as it is edited now (vagus plan generate): NAME.cpp. A plan with errors has none; then the findings say why. */
  'plan.code': { in: {
    doc: Doc;
  }; out: {
    /** of the file */
    name: string;
    text: string;
    marks: CodeMark[];
    /** errors */
    findings: Finding[];
  } };
  /** A template of the project's own: into its toolbox file, which is made and listed in vagus.json if need be, with the events it needs and handlers in the script of a node. Unchanged it works and does something harmless. All of it, or nothing. */
  'template.new': { in: {
    name: Name;
    kind: 'actor' | 'supervisor';
    /** whose node does the work */
    script: Doc;
    help: string;
    seen?: DocVersion[];
  }; out: {
    toolbox: string;
    /** in the script, where its author goes on */
    at: Place;
  } };
  /** Adds an event or constant to an .aesl file. */
  'define.add': { in: {
    file: Path;
    kind: 'event' | 'constant';
    name: Name;
    value: number;
    seen?: DocVersion[];
  }; out: Record<never, never> };
  /** Changes its value or name; scripts, plans and toolboxes of the project follow the name. */
  'define.change': { in: {
    file: Path;
    kind: 'event' | 'constant';
    name: Name;
    to: Name;
    value: number;
    seen?: DocVersion[];
  }; out: {
    places: number;
    /** plans and toolboxes that were changed, too */
    others: Path[];
  } };
  /** Removes it. */
  'define.remove': { in: {
    file: Path;
    kind: 'event' | 'constant';
    name: Name;
    seen?: DocVersion[];
  }; out: Record<never, never> };
  /** Moves it within its list; numbers of events follow their order. */
  'define.move': { in: {
    file: Path;
    kind: 'event' | 'constant';
    name: Name;
    to: number;
    seen?: DocVersion[];
  }; out: Record<never, never> };
  /** Connects to a target: sim, or one of the command line's. What ran before is stopped. */
  'target.choose': { in: {
    target: string;
  }; out: Record<never, never> };
  /** Disconnects. */
  'target.leave': { in: Record<never, never>; out: Record<never, never> };
  /** Compiles and loads scripts; a node that gets a program runs it. */
  'node.load': { in: {
    /** 0: every node that has a script */
    node: number;
    /** let it run (true) */
    run?: boolean;
  }; out: {
    loaded: NodeId[];
    failed: Failed[];
  } };
  /** Looks at a fleet, in place of the one that is open. A broker that is not there is looked for until it is. */
  'fleet.open': { in: {
    /** mqtt[s]://HOST[:PORT]/FLEET */
    target: string;
    /** a file of the server's computer, as the following: who signed the broker's certificate */
    ca?: string;
    /** user and password, two lines */
    login?: string;
    /** instead of a login */
    certificate?: string;
    key?: string;
  }; out: Record<never, never> };
  /** Looks at no fleet. */
  'fleet.close': { in: Record<never, never>; out: Record<never, never> };
  /** Tells robots of the fleet what to do. It is answered when each has, or within 10 s. */
  'fleet.order': { in: {
    verb: 'pause' | 'continue' | 'start' | 'set' | 'raise' | 'emit';
    robots: string[];
    /** of set; without it a variable of the plan */
    node?: string;
    /** of set */
    name?: string;
    /** of set; arguments of emit */
    values?: number[];
    /** of raise */
    supervisor?: string;
    /** of raise and emit */
    event?: string;
  }; out: {
    outcomes: FleetOutcome[];
  } };
  /** The project that is open, as it is saved, for robots of the fleet, in steps. It is answered when the first is told; what becomes of each is the topic rollout. */
  'fleet.deploy': { in: {
    /** without it all */
    robots?: string[];
    /** how many have it after each step, as 1,10%,100% */
    steps?: string;
    /** files whose unsaved changes are not part of it; it is refused while another one has some */
    without?: Path[];
  }; out: Record<never, never> };
  /** Robots that have the version of the last roll-out get the one before, all at once. */
  'fleet.rollback': { in: Record<never, never>; out: Record<never, never> };
  /** No other robot gets the version; robots that have it keep it. */
  'fleet.rollout_stop': { in: Record<never, never>; out: Record<never, never> };
  /** Stops robots of the fleet, asking again until each has answered, for 10 s. */
  'fleet.stop': { in: {
    /** without it all */
    robots?: string[];
  }; out: {
    outcomes: FleetOutcome[];
  } };
  /** Lets a node run, or continues it. */
  'node.run': { in: {
    /** 0: all */
    node: number;
  }; out: {
    failed: Failed[];
  } };
  /** Pauses a node. */
  'node.pause': { in: {
    /** 0: all */
    node: number;
  }; out: {
    failed: Failed[];
  } };
  /** To the next line. */
  'node.step': { in: {
    /** 0: all that are paused */
    node: number;
  }; out: {
    failed: Failed[];
  } };
  /** Stops a node's program; its next run starts from the beginning. */
  'node.stop': { in: {
    /** 0: all */
    node: number;
  }; out: {
    failed: Failed[];
  } };
  /** Begins a node's program from its start. */
  'node.reset': { in: {
    /** 0: all */
    node: number;
  }; out: {
    failed: Failed[];
  } };
  /** The node keeps its program for its next start. */
  'node.save': { in: {
    /** 0: all */
    node: number;
  }; out: {
    failed: Failed[];
    notes: NodeNote[];
  } };
  /** Sets or changes a breakpoint; also without a robot. */
  'break.set': { in: {
    doc: Doc;
    line: number;
    condition?: string;
    ignore?: number;
    enabled?: boolean;
  }; out: {
    /** where it is: the next line with code */
    line: number;
    /** what it does to a robot that is alive */
    note?: string;
  } };
  /** Removes a breakpoint, or all. */
  'break.clear': { in: {
    doc?: Doc;
    line?: number;
  }; out: Record<never, never> };
  /** Writes a variable of a node. */
  'variable.set': { in: {
    node: NodeId;
    name: Name;
    first: number;
    values: Words;
  }; out: Record<never, never> };
  /** Sends an event on the bus. */
  'event.send': { in: {
    name: Name;
    args: number[];
  }; out: Record<never, never> };
  /** Runs the robot: loads scripts that changed, lets nodes run, starts the plan if the project has one. Continues what is paused. */
  'run.start': { in: {
    /** variables of the plan */
    set?: Record<string, Json>;
  }; out: Record<never, never> };
  /** Pauses the clock of a simulation with all that is in it; on a bus the plan and every node. */
  'run.pause': { in: Record<never, never>; out: Record<never, never> };
  /** One instant of a simulation that is paused. */
  'run.step': { in: {
    ms?: number;
  }; out: Record<never, never> };
  /** The simulation as it was at an instant of the run that goes or went last: its beginning is run again from its recording, then files that have changed since take over, and it runs on. */
  'run.continue': { in: {
    t: number;
    /** it stays there */
    paused?: boolean;
    /** variables of the plan get these values there, after the files */
    set?: PlanSetting[];
  }; out: Record<never, never> };
  /** The simulation as at its start, time 0. */
  'run.reset': { in: Record<never, never>; out: Record<never, never> };
  /** Ends a runner that hangs. */
  'run.end': { in: Record<never, never>; out: Record<never, never> };
  /** Speed of a simulation against the wall clock; 0: as fast as it goes. */
  'clock.speed': { in: {
    speed: number;
  }; out: Record<never, never> };
  /** Starts the plan alone. */
  'plan.start': { in: {
    doc?: Doc;
    set?: Record<string, Json>;
    /** the actor that it begins with, instead of its start */
    from?: Name;
  }; out: Record<never, never> };
  /** Whether saving the document as it is now would change the plan that runs (P31). */
  'plan.check_change': { in: {
    doc: Doc;
  }; out: {
    /** the plan that runs is made of it */
    runs: boolean;
    /** why the plan that runs could not change so; none: it would take over at once */
    reasons: string[];
  } };
  /** What differs between another version of a plan and its document as it is now, places included: the one on disk, the one that runs, the one that ran at an instant, that of a git revision, or another plan file. */
  'plan.differences': { in: {
    doc: Doc;
    against: 'disk' | 'running' | 'then' | 'revision' | 'file';
    /** for then: an instant of the run */
    t?: number;
    /** for revision */
    revision?: string;
    /** for file */
    file?: Path;
  }; out: {
    /** of the document */
    version: number;
    /** the other version in its saved form */
    before: string;
    differences: PlanDifference[];
  } };
  /** The last commits that changed the file of a plan, the newest first; none if its folder is in no git repository. */
  'plan.versions': { in: {
    doc: Doc;
  }; out: {
    versions: GitVersion[];
  } };
  /** Tries a plan without a robot: from its beginning each actor ends, and each supervisor raises, as was chosen, a second after what came before; computations compute as ever. Documents count as they are edited. */
  'plan.try': { in: {
    doc: Doc;
    way: TryChoice[];
  }; out: {
    plan: TriedPlan;
    /** missing: the plan has ended */
    waits?: TryWait;
    raises: TryRaise[];
    turns: TryTurn[];
    /** when each choice was taken */
    taken: number[];
    /** choices at the end of the way that could not be taken */
    left: number;
  } };
  /** Writes a test beside the plan that takes the same way (vagus test), with answers in place of work. */
  'plan.try.keep': { in: {
    doc: Doc;
    way: TryChoice[];
  }; out: {
    path: Path;
  } };
  /** Pauses the plan. */
  'plan.pause': { in: Record<never, never>; out: Record<never, never> };
  /** Continues the plan. */
  'plan.continue': { in: Record<never, never>; out: Record<never, never> };
  /** On to the next actor. */
  'plan.step': { in: Record<never, never>; out: Record<never, never> };
  /** Ends the plan as from outside (P28). */
  'plan.stop': { in: Record<never, never>; out: Record<never, never> };
  /** The plan goes on until the handler of one of these events begins on a node, which is then paused there. */
  'plan.into': { in: {
    events: Name[];
  }; out: {
    spots: Spot[];
  } };
  /** Raises an event of a supervisor that watches, as if it had done so itself. */
  'plan.raise': { in: {
    supervisor: Name;
    event: Name;
    outputs?: Record<string, Json>;
  }; out: Record<never, never> };
  /** Hands an event that waits to the plan, before all others; the plan handles it when it continues. Without a number all, in their order. */
  'plan.held.go': { in: {
    number?: number;
  }; out: Record<never, never> };
  /** The plan goes on with one event that waits, without a number the first, to the next thing that it does, for 100 ms at most; all others stay. */
  'plan.held.step': { in: {
    number?: number;
  }; out: Record<never, never> };
  /** Drops an event that waits for the plan; without a number all. */
  'plan.held.drop': { in: {
    number?: number;
  }; out: Record<never, never> };
  /** Sets a breakpoint of a plan, or changes the one at that place or of that number; also when nothing runs. */
  'plan.break.set': { in: {
    number?: number;
    doc: Doc;
    kind: 'actor' | 'state' | 'event' | 'condition';
    element?: string;
    outcome?: string;
    condition?: string;
    stop_at?: number;
    enabled?: boolean;
  }; out: {
    number: number;
  } };
  /** Removes a breakpoint of a plan, those of a document, or all. */
  'plan.break.clear': { in: {
    number?: number;
    doc?: Doc;
  }; out: Record<never, never> };
  /** Writes a variable of a running plan (P29). */
  'plan.set': { in: {
    level: number;
    name: Name;
    value: Json;
  }; out: Record<never, never> };
  /** An instant of the run, or of a trace that is kept as a file. What was not recorded is null or missing. */
  'history.at': { in: {
    t: number;
    /** words of nodes that are asked for: [node, address, count] */
    ranges?: Json[];
    /** so many of the last happenings until then */
    events?: number;
    /** where sensors looked, and lamps, are asked for */
    rays?: boolean;
    /** the robot whose camera is asked for */
    picture?: string;
    trace?: Path;
    /** whose plan, as for history.open */
    robot?: string;
  }; out: {
    run: number;
    t: number;
    /** until when something is known */
    to: number;
    /** as the topic plan was; missing without a plan */
    plan?: Json;
    /** when the plan made its last step before */
    before?: number;
    /** when it made its next one */
    next?: number;
    values: HistoryWords[];
    /** [index in the scene, x, y, angle] */
    robots: Json[];
    /** [number, x, y, angle] */
    objects: Json[];
    nodes: HistoryNode[];
    events: Happening[];
    /** missing: thinned out, up to 0.2 s older than asked */
    exact?: boolean;
    /** base64: a payload of the topic rays */
    rays?: string;
    /** base64: a payload of the topic picture; missing: none of the last 5 s was kept */
    picture?: string;
    /** when it was taken */
    picture_t?: number;
  } };
  /** What a timeline draws of a span of time: what falls into one of its pixels is merged. */
  'history.lanes': { in: {
    from: number;
    to: number;
    /** pixels */
    width: number;
    /** [node, address] */
    words?: Json[];
    trace?: Path;
    /** whose plan, as for history.open */
    robot?: string;
  }; out: {
    run: number;
    from: number;
    to: number;
    lanes: HistoryLane[];
    curves: HistoryCurve[];
    loads: HistoryCurve[];
    /** events of sources that had no room */
    left_out: number;
  } };
  /** Where robots of a world went: a place for each centimetre, the newest 4000 of a robot, 40000 of all. */
  'history.ways': { in: {
    from: number;
    to: number;
  }; out: {
    run: number;
    /** [index in the scene, t, x, y, t, x, y, …] */
    ways: Json[];
  } };
  /** Reads a run that is kept as a file, and runs nothing: a trace, NAME.trace.jsonl, or what a recording says, NAME.mcap. */
  'history.open': { in: {
    trace: Path;
    /** of a recording in which robots have projects of their own: whose plan; missing: that of the first */
    robot?: string;
  }; out: {
    from: number;
    to: number;
    lines: number;
    /** lines that are none of a trace */
    refused: number;
    /** the project has the plan of that name */
    plan: boolean;
    /** that have projects of their own */
    robots?: string[];
    /** the one of them whose plan is shown */
    robot?: string;
    /** as the topic scene: the world of a recording */
    scene?: Json;
  } };
  /** Keeps the trace of the run as a file of the project. */
  'history.save': { in: Record<never, never>; out: {
    path: Path;
  } };
  /** The recordings of runs that this project keeps, the newest first, without that of the run that is there. */
  'recording.list': { in: Record<never, never>; out: {
    recordings: KeptRecording[];
  } };
  /** Runs a recorded run of this project's plan or world again, to its end, with the files of then: it can be looked back into, asked, and continued. One that cannot be run again, as that of a real robot, is looked at by history.open. */
  'recording.open': { in: {
    path: Path;
    /** it is run from its beginning as the clock goes, to be watched and changed, instead */
    live?: boolean;
  }; out: {
    /** missing: it is run again; false: it cannot be */
    again?: boolean;
    /** why not */
    why?: string;
  } };
  /** Writes a test of the simulated run that goes or went last, beside its plan: the order of its actors, by when the last of them had come, that nothing touched the robot, and how it ended. Of a run without a plan it is beside the world: which events came first, and where the robot was at the end. The test is run once first, with the files as they are saved. */
  'test.keep': { in: Record<never, never>; out: {
    path: Path;
    /** from the beginning, with these files, the run was another one: a run that was changed on its way is; the test expects what that one did */
    differs: boolean;
  } };
  /** Saves all, then runs tests of behaviour with each of their seeds, in processes of their own, beside whatever runs. One set of tests at a time. */
  'tests.run': { in: {
    /** missing: all of the project */
    tests?: Path[];
    /** lines of scripts are counted, too, which takes several times as long */
    scripts?: boolean;
  }; out: Record<never, never> };
  /** Ends the run of tests; what came of seeds until then stays. */
  'tests.stop': { in: Record<never, never>; out: Record<never, never> };
  /** Why something in a run is as it is: the run is run again from its recording; of a robot on a bus what its plan decided is, and the rest is told as far as frames tell. Of the run that goes or went last, at an instant or, without one, as far as it is recorded. */
  'why.ask': { in: {
    about: 'actor' | 'variable' | 'motor' | 'event' | 'end';
    /** of an actor, a robot, an event; of a variable, or NODE.NAME of a node's */
    name?: string;
    t?: number;
    /** a recording that is shown without a run */
    trace?: Path;
    /** of such a recording in which robots have projects of their own: whose actor, variable, event or end */
    robot?: string;
  }; out: {
    /** the newest first */
    chain: WhyLink[];
  } };
  /** When it was decided that a condition becomes true in the run that is shown, or does not: the run is continued again and again with other seeds, in processes of their own, beside whatever runs. The topic turning tells what comes of it. One question at a time. */
  'turning.ask': { in: {
    /** as in tests of behaviour */
    condition: string;
    /** continuations from each instant; missing: 20 */
    tries?: number;
  }; out: Record<never, never> };
  /** Ends the search of turning.ask. */
  'turning.stop': { in: Record<never, never>; out: Record<never, never> };
  /** What variables held each time that a line of a script or an element of the plan was reached in the run that is shown: it is run again from its recording, all of it, which changes nothing. Of a run that goes on there is what is recorded by now. */
  'log.ask': { in: {
    /** for log.cancel, of the client's choice */
    number: number;
    doc: Doc;
    /** of a script; it is reached as by a breakpoint there */
    line?: number;
    /** of a plan: an actor, or a supervisor */
    element?: string;
    /** of the element; leave: it ended, or was interrupted */
    when?: 'enter' | 'leave' | 'raise';
    /** with commas between them: of a node, variables and expressions in AESL; of a plan, formulas */
    values: string;
  }; out: {
    /** the values as they were asked */
    names: string[];
    /** the oldest first */
    hits: LogHit[];
    /** that follow these */
    more: number;
    /** so far the run was asked */
    until: number;
    /** the line of the script as the recording has it; empty: of the plan */
    text: string;
  } };
  /** Two recorded runs side by side: where each lane of them differs first, the earliest before the others, and what both are drawn from. Without a path: the run that is shown, as far as it is recorded. */
  'runs.compare': { in: {
    a?: Path;
    b?: Path;
    /** what is laid one over the other */
    align: 'start' | 'actor' | 'event';
    /** of the actor, which begins first then; of the event */
    name?: string;
  }; out: {
    a: ComparedRun;
    b: ComparedRun;
    lanes: ComparedLane[];
    started: StartedApart[];
    /** at the beginning of a */
    scene: ComparedShape[];
  } };
  /** A log.ask of this client is not to be answered any more: it fails. */
  'log.cancel': { in: {
    number: number;
  }; out: Record<never, never> };
  /** Puts a robot or an object somewhere else, as a hand would. */
  'world.move': { in: {
    robot?: string;
    object?: number;
    at: Point;
    angle?: number;
  }; out: Record<never, never> };
  /** Puts an object into the running world, not into the file. */
  'world.put': { in: {
    kind: 'wall' | 'box' | 'cylinder' | 'patch' | 'light' | 'infrared';
    at: Point;
    angle?: number;
    /** unlike that of any other object */
    id?: string;
    /** of a rectangle */
    size?: number[];
    /** of a disc */
    radius?: number;
    height?: number;
    mass?: number;
    colour?: Colour;
    /** of a lamp; missing: it is */
    on?: boolean;
  }; out: {
    number: number;
  } };
  /** Deletes an object from the running world. */
  'world.take': { in: {
    object: number;
  }; out: Record<never, never> };
  /** Presses a button or touch sensor of a robot. */
  'world.press': { in: {
    robot: string;
    button: string;
    down: boolean;
  }; out: Record<never, never> };
  /** Taps a robot. */
  'world.tap': { in: {
    robot: string;
  }; out: Record<never, never> };
  /** Switches a light or beacon. */
  'world.light': { in: {
    object: number;
    on: boolean;
  }; out: Record<never, never> };
  /** Keeps a part of the window in .vagus/state.json: layout, open tabs, watches. */
  'state.put': { in: {
    key: string;
    value: Json;
  }; out: Record<never, never> };
  /** Keeps a setting of the user. */
  'settings.put': { in: {
    key: string;
    value: Json;
  }; out: Record<never, never> };
}

export interface Topics {
  /** What the whole window shows. */
  'studio': { kind: 'document'; of: Record<never, never>; is: {
    version: string;
    /** number of the client that drives, 0: nobody */
    driver: number;
    driver_name: string;
    asked?: Asked;
    clients: number;
    /** none: start screen */
    project?: Project;
    /** a robot that serves this project on this target; others are refused */
    serves?: boolean;
    settings: Json;
    /** unsaved texts of an earlier session */
    recovered: Doc[];
  } };
  /** What the start screen offers. */
  'start': { kind: 'document'; of: Record<never, never>; is: {
    examples: Example[];
    recent: Recent[];
  } };
  /** Targets that were found. Looked for while somebody watches this. */
  'targets': { kind: 'document'; of: Record<never, never>; is: {
    found: Found[];
  } };
  /** Files of the project. */
  'files': { kind: 'document'; of: Record<never, never>; is: {
    files: FileEntry[];
    more: boolean;
  } };
  /** How a text is; doc.pull gets what changed in it. A document that cannot be opened has version 0. */
  'doc': { kind: 'document'; of: {
    doc: Doc;
  }; is: {
    epoch: string;
    version: number;
    language: 'aesl' | 'aesl-file' | 'plan' | 'world' | 'toolbox' | 'json' | 'text';
    ends: 'lf' | 'crlf' | 'mixed';
    unsaved: boolean;
    /** of the last step */
    by: string;
    /** the file changed on disk where the text has unsaved changes: doc.disk shows it, doc.keep chooses, until then nothing is saved */
    disk: boolean;
    /** while disk is true: which file that is; another one after somebody else wrote it again */
    disk_hash?: string;
    /** why what is there is no text that can be shown or taken */
    disk_no_text?: string;
    /** the file is not on disk; saving makes it again */
    gone: boolean;
    /** the file was renamed: what the document is now */
    moved?: Doc;
  } };
  /** All mistakes and remarks of the project. */
  'findings': { kind: 'document'; of: Record<never, never>; is: {
    findings: Finding[];
    more: number;
    /** by document: the text they are for */
    versions: Record<string, number>;
  } };
  /** What plans of the project can be made of. That of a shared library is not known. */
  'templates': { kind: 'document'; of: Record<never, never>; is: {
    toolboxes: PlanToolbox[];
    /** what formulas can be made of, apart from variables */
    formulas: FormulaWord[];
  } };
  /** What the compiler knows of a script. */
  'script': { kind: 'document'; of: {
    doc: Doc;
  }; is: {
    version: number;
    good: boolean;
    node: Name;
    /** the description it is compiled for */
    for: string;
    bytecode: Meter;
    variables: Meter;
    stack: Meter;
    handlers: Handler[];
    /** lines that can hold a breakpoint */
    code_lines: number[];
  } };
  /** Scripts, events and constants of the project. */
  'scripts': { kind: 'document'; of: Record<never, never>; is: {
    parts: ScriptPart[];
    files: SharedFile[];
  } };
  /** The target and its nodes. */
  'robot': { kind: 'document'; of: Record<never, never>; is: {
    target: string;
    name: string;
    kind: 'none' | 'simulator' | 'bus';
    state: 'none' | 'connecting' | 'connected' | 'lost' | 'failed';
    why?: string;
    since_wall?: number;
    nodes: Node[];
    /** two nodes with one id */
    twins: string[];
    /** of the bus, in percent */
    load?: number;
    lost: number;
    events_a_second: number;
  } };
  /** The fleet that is looked at, with what each robot told last. */
  'fleet': { kind: 'document'; of: Record<never, never>; is: {
    /** of the connection to its broker */
    state: 'none' | 'connecting' | 'connected' | 'lost';
    target?: string;
    /** its name */
    fleet?: string;
    /** of the login; empty: none */
    user?: string;
    /** why it is not connected */
    why?: string;
    robots: Record<string, FleetRobot>;
  } };
  /** The last roll-out that a page of this studio gave to a fleet, also of a studio before this one. */
  'rollout': { kind: 'document'; of: Record<never, never>; is: {
    /** left: it was stopped, or its studio ended */
    state: 'none' | 'running' | 'well' | 'failed' | 'left';
    /** of the fleet */
    target: string;
    /** the one that is open, which would be sent; missing: none */
    project?: string;
    /** the project that was sent */
    version: string;
    /** the version before is put in force */
    back: boolean;
    /** who gave it */
    by: string;
    /** why it was left */
    why: string;
    begun_wall: number;
    /** a robot that comes back can fetch it here */
    served: boolean;
    robots: Record<string, RolloutRobot>;
  } };
  /** Events that robots of the fleet sent, who came and went, what pages of this studio told them, from the last ones kept. */
  'fleet_events': { kind: 'stream'; of: {
    last?: number;
    kinds?: string[];
  }; is: FleetEvent };
  /** Links and who talks to whom. */
  'network': { kind: 'document'; of: Record<never, never>; is: {
    links: Link[];
    traffic: Traffic[];
  } };
  /** What a node is. */
  'node': { kind: 'document'; of: {
    node: NodeId;
  }; is: {
    name: Name;
    variables: Variable[];
    events: LocalEvent[];
    natives: Native[];
  } };
  /** All breakpoints, of scripts and of plans. */
  'breakpoints': { kind: 'document'; of: Record<never, never>; is: {
    breakpoints: Breakpoint[];
    plans: PlanBreakpoint[];
  } };
  /** The clock of the run. t is sent at most 10 times a second. */
  'clock': { kind: 'document'; of: Record<never, never>; is: {
    t: number;
    wall: number;
    state: 'none' | 'running' | 'paused' | 'ended' | 'hanging' | 'dead';
    speed: number;
    /** measured */
    real: number;
    /** why it ended */
    why?: string;
  } };
  /** The last end of a run. */
  'end': { kind: 'document'; of: Record<never, never>; is: {
    end?: RunEnd;
    /** a node was not read back as stopped, and nobody has acknowledged it */
    open: boolean;
  } };
  /** The plan that runs. */
  'plan': { kind: 'document'; of: Record<never, never>; is: {
    state: 'none' | 'running' | 'paused' | 'ended';
    doc?: Doc;
    t: number;
    result?: 'OK' | 'Interrupted' | 'Error';
    message?: string;
    /** numbers of the breakpoints that hold it */
    stands_at?: number[];
    levels: PlanLevel[];
    /** what happened, the newest last */
    story: Line[];
    /** what came of the last save while it ran */
    change?: PlanChange;
  } };
  /** What is kept of the run that goes, or went last: history.at and history.lanes show it. */
  'history': { kind: 'document'; of: Record<never, never>; is: {
    /** another one for each run */
    run: number;
    kind: 'none' | 'simulated' | 'bus' | 'trace';
    name: string;
    from: number;
    to: number;
    /** what is older is thinned out to 5 instants a second */
    fine_from?: number;
    /** older lines of the trace are not kept */
    plan_from?: number;
    /** older events are not kept */
    events_from?: number;
  } };
  /** The last turning.ask, its progress and its result. */
  'turning': { kind: 'document'; of: Record<never, never>; is: {
    state: 'none' | 'running' | 'done' | 'stopped' | 'failed';
    /** of the topic history: the one that it was asked of */
    run?: number;
    condition?: string;
    tries?: number;
    progress?: TurningProgress;
    /** why it failed */
    why?: string;
    result?: Turning;
  } };
  /** Tests of behaviour that are run, or were run last. */
  'tests': { kind: 'document'; of: Record<never, never>; is: {
    state: 'none' | 'running' | 'done' | 'stopped' | 'failed';
    /** why it failed */
    why?: string;
    /** of all tests together */
    runs: number;
    done: number;
    failed: number;
    /** lines of scripts are counted */
    scripts: boolean;
    tests: TestRun[];
    coverage: CoverageRow[];
    /** files whose text is another one than it was when they were run */
    changed: Path[];
  } };
  /** What the last run of tests took of a plan or a script. */
  'coverage': { kind: 'document'; of: {
    doc: Doc;
  }; is: {
    /** the text is another one by now */
    changed: boolean;
    plan?: PlanCoverage;
    /** of a script */
    lines?: LineCoverage[];
  } };
  /** What state.put kept. */
  'state': { kind: 'document'; of: Record<never, never>; is: {
    values: Json;
  } };
  /** What is in the world; where it is comes by poses. */
  'scene': { kind: 'document'; of: Record<never, never>; is: {
    /** another one each time a world is opened; numbers of objects begin again */
    opening?: number;
    name: string;
    size: number[];
    open: boolean;
    ground: Colour;
    image?: Path;
    robots: Robot[];
    objects: SceneObject[];
  } };
  /** Events of the bus that wait while the plan is paused in its debugger. */
  'held': { kind: 'document'; of: Record<never, never>; is: {
    stands: boolean;
    events: HeldEvent[];
    /** that wait behind these */
    more: number;
    /** that came when 1000 waited already */
    dropped: number;
  } };
  /** What happened on the bus, from the last ones kept. */
  'happenings': { kind: 'stream'; of: {
    last?: number;
    kinds?: string[];
  }; is: Happening };
  /** What the server, the run and the plan say. */
  'console': { kind: 'stream'; of: {
    last?: number;
  }; is: Line };
  /** Values of variables of a node, when they change; of at most 4096 words, ranges that overlap being one. Payload: records of u16 address, u16 count, count times i16. */
  'variables': { kind: 'binary'; of: {
    node: NodeId;
    /** [address, count] */
    ranges: Json[];
  } };
  /** Every value that was seen of some words, for plots. Payload: records of f64 time, u16 index into of.words, i16 value. */
  'samples': { kind: 'binary'; of: {
    /** [node, address] */
    words: Json[];
  } };
  /** Where things are. Payload: u16 robots, u16 objects; for each robot f32 x, y, angle; for each object that moves u32 number, f32 x, y, angle. Robots in the order of scene. */
  'poses': { kind: 'binary'; of: Record<never, never> };
  /** Looks of distance sensors, and lamps, in the frame of their robot (x ahead, y to the left). Payload: u16 looks, u16 lamps; looks: u16 robot, u16 hit, f32 x, y, x, y; lamps: u16 robot, u16 0, f32 x, y, f32 red, green, blue. */
  'rays': { kind: 'binary'; of: Record<never, never> };
  /** What a camera sees. Payload: u16 width, u16 height, RGB bytes. */
  'picture': { kind: 'binary'; of: {
    robot: string;
  } };
}

export type CommandName = keyof Commands;
export type TopicName = keyof Topics;
export type TopicOf<K extends 'document' | 'stream' | 'binary'> = {
  [T in TopicName]: Topics[T]['kind'] extends K ? T : never;
}[TopicName];

export type CommandKind = 'look' | 'edit' | 'act' | 'stop';
type Fields = Readonly<Record<string, string>>;

/** The same at run time, for the check of what arrives. */
export const typeTable: Readonly<Record<string, string | Fields>> = {
  Doc: 'line(512)',
  Path: 'line(512)',
  Name: 'line(128)',
  NodeId: 'int(1..65534)',
  Words: '[int(-32768..32767); 600]',
  Place: { line: 'int(1..10000000)', column: 'int(1..10000000)' },
  Edit: { doc: 'Doc', from: 'int(0..2097152)', to: 'int(0..2097152)', text: 'text(2097152)' },
  Change: { from: 'int(0..2097152)', to: 'int(0..2097152)', text: 'text(2097152)' },
  Update: { version: 'int(0..4294967295)', changes: '[Change; 1000]', by: 'line(64)' },
  DocVersion: { doc: 'Doc', version: 'int(0..4294967295)', epoch: 'line(32)?' },
  Fix: { label: 'line(200)', edits: '[Edit; 100]' },
  Finding: { doc: 'Doc', severity: 'word(error|warning)', code: 'line(64)', element: 'line(256)?', at: 'Place', end: 'Place', what: 'text(2000)', fixes: '[Fix; 8]', keys: '[json; 100]?' },
  Problem: { code: 'word(bad_message|unknown_command|not_allowed|not_driver|not_found|bad_input|conflict|behind|limit|unavailable|timeout|failed|late)', what: 'text(4000)', place: 'line(600)?' },
  FileEntry: { path: 'Path', kind: 'word(folder|script|plan|world|toolbox|project|picture|text|other)', size: 'int(0..1000000000000)', unsaved: 'bool' },
  Found: { target: 'line(256)', name: 'line(256)', kind: 'word(simulator|serial|local|network)', help: 'line(300)' },
  Example: { id: 'line(64)', name: 'line(100)', help: 'line(300)', robot: 'line(100)', content: 'line(100)' },
  Recent: { path: 'line(1024)', name: 'line(200)', when_wall: 'number', there: 'bool' },
  ScriptPart: { doc: 'Doc', name: 'Name', node: 'int(0..65534)', file: 'Path' },
  Definition: { name: 'Name', value: 'int(-32768..65535)' },
  Handler: { kind: 'word(init|event|sub)', name: 'Name', line: 'int(0..10000000)', words: 'int(0..65535)' },
  Meter: { used: 'int(0..65535)', of: 'int(0..65535)' },
  Breakpoint: { doc: 'Doc', line: 'int(1..10000000)', condition: 'line(500)', ignore: 'int(0..1000000)', enabled: 'bool', hits: 'int(0..4294967295)', set: 'bool', why: 'line(300)?' },
  PlanBreakpoint: { number: 'number', doc: 'Doc', kind: 'word(actor|state|event|condition)', element: 'line(128)', outcome: 'line(128)', condition: 'line(500)', stop_at: 'number', enabled: 'bool', hits: 'number', set: 'bool', why: 'text(2000)?' },
  HeldEvent: { number: 'number', t: 'number', after: 'number', node: 'int(0..65534)', name: 'Name', args: 'Words' },
  Node: { id: 'NodeId', name: 'Name', robot: 'line(128)', state: 'word(unknown|running|paused|stopped|gone)', protocol: 'int(0..255)', described: 'bool', doc: 'Doc?', program: 'word(none|unknown|older|current)', loaded_wall: 'number?', at: 'Place?', why: 'word(asked|breakpoint|step|fault|start|robot)?', stop: 'word(asked|stopped|moving|silent|gone)?', fault: 'text(500)?', busy: 'line(100)?', dropped: 'number?' },
  StopNode: { node: 'NodeId', name: 'line(255)', state: 'word(asked|stopped|moving|silent|gone)' },
  Link: { name: 'line(300)', nodes: '[NodeId; 1024]', frames_in: 'number', frames_out: 'number', lost: 'number' },
  Traffic: { from: 'int(0..65534)', event: 'Name', count: 'number', to: '[int(0..65534); 1024]' },
  Variable: { name: 'Name', address: 'int(0..65535)', size: 'int(1..65535)', of: 'word(node|script)', unit: 'line(32)?', help: 'line(400)?', writable: 'bool' },
  Native: { name: 'Name', help: 'line(400)', parameters: '[Parameter; 32]' },
  Parameter: { name: 'Name', size: 'int(-65535..65535)' },
  LocalEvent: { name: 'Name', help: 'line(400)' },
  Happening: { number: 'number', run: 'number?', t: 'number', wall: 'number', kind: 'word(event|state|fault|appeared|gone|loaded|plan|lost)', node: 'int(0..65534)', source: 'line(128)', name: 'line(200)', args: 'Words', text: 'text(1000)' },
  HistoryBar: { from: 'number', to: 'number?', name: 'line(200)?', end: 'line(200)?', count: 'number?' },
  HistoryMark: { t: 'number', name: 'line(200)?', to: 'line(200)?', count: 'number?' },
  HistoryLane: { kind: 'word(actors|supervisor|events)', path: 'line(4096)', name: 'line(200)', bars: '[HistoryBar; 20000]', marks: '[HistoryMark; 20000]' },
  HistoryCurve: { node: 'int(0..65534)', address: 'int(0..65535)?', low: 'json?', high: 'json' },
  HistoryWords: { node: 'NodeId', address: 'int(0..65535)', words: '[json; 20000]' },
  HistoryNode: { node: 'NodeId', state: 'line(32)', line: 'int(1..10000000)?' },
  WhyLink: { t: 'number', what: 'line(1000)', value: 'line(1000)', place: 'line(1200)', doc: 'Doc?', line: 'int(1..10000000)?', element: 'line(256)?', root: 'bool' },
  TurningProgress: { stage: 'word(run|curve|narrowing|recordings)', done: 'number', of: 'number' },
  TurningPoint: { t: 'number', came: 'number', of: 'number', low: 'number', high: 'number', end: 'bool' },
  Turn: { before: 'TurningPoint', after: 'TurningPoint', narrowed: 'bool', with: 'Path?', without: 'Path?', there: '[WhyLink; 1001]' },
  Turning: { sentence: 'line(400)', came: 'number?', end: 'number', continuations: 'number', curve: '[TurningPoint; 33]', turn: 'Turn?' },
  ComparedLane: { name: 'line(256)', compared: 'number', t: 'number?', place: 'line(1000)?', a: 'line(1000)?', b: 'line(1000)?' },
  ComparedRun: { path: 'line(1024)', start: 'number', end: 'number', complete: 'bool', actors: '[ComparedActor; 5000]', events: '[ComparedEvent; 5000]', ways: '[ComparedWay; 64]', more: 'number' },
  ComparedActor: { name: 'line(256)', level: 'int(0..1000)', from: 'number', to: 'number' },
  ComparedEvent: { name: 'line(256)', supervisor: 'line(256)', t: 'number' },
  ComparedWay: { robot: 'line(256)', length: 'number', width: 'number', points: '[number; 8000]' },
  ComparedShape: { round: 'bool', at: 'Point', angle: 'number', size: '[number; 2]' },
  StartedApart: { what: 'line(1000)', a: 'line(1000)', b: 'line(1000)' },
  LogHit: { t: 'number', where: 'line(256)', values: '[line(1000); 16]' },
  TestRun: { path: 'Path', runs: 'number', done: 'number', failed: 'number', why: 'line(2000)?', at: 'Place?', failures: '[TestFailure; 100]' },
  TestFailure: { seed: 'number', t: 'number?', at: 'Place?', expected: 'line(1000)?', what: 'line(2000)', help: 'line(500)?', recording: 'Path?' },
  CoverageRow: { path: 'Path', kinds: '[CoverageShare; 8]' },
  CoverageShare: { name: 'word(actors|states|supervisors|events|pairs|lines|branches)', taken: 'number', of: 'number' },
  PlanCoverage: { actors: '{number; 100000}', states: '{number; 100000}', supervisors: '{number; 100000}', events: '{number; 100000}', pairs: '{number; 100000}' },
  LineCoverage: { line: 'int(1..10000000)', count: 'number', ways: 'number?', taken: 'number?' },
  Line: { number: 'number', t: 'number', kind: 'word(note|warning|error|log)', text: 'text(4000)' },
  Suggestion: { label: 'line(200)', kind: 'word(variable|constant|event|native|sub|keyword|function|actor|supervisor|template|value)', detail: 'line(300)', help: 'text(1000)', insert: 'line(400)' },
  Spot: { doc: 'Doc', at: 'Place', end: 'Place', line_text: 'line(400)' },
  Robot: { name: 'line(128)', type: 'word(thymio2|epuck|carbot)', nodes: '[NodeId; 16]', outline: '[Point; 64]', paint: 'Colour', height: 'number', camera: 'bool', buttons: '[line(64); 64]' },
  Point: '[number; 2]',
  Colour: '[number; 3]',
  SceneObject: { id: 'line(128)', number: 'number', kind: 'word(wall|box|cylinder|patch|light|infrared)', size: '[number; 2]?', radius: 'number?', height: 'number', mass: 'number', colour: 'Colour', on: 'bool' },
  PlanInput: { name: 'Name', type: 'word(any|bool|int|float|string|object)', unit: 'line(32)', help: 'line(1000)', default: 'json?', low: 'number?', high: 'number?' },
  PlanOutput: { name: 'Name', type: 'word(any|bool|int|float|string|object)', unit: 'line(32)', help: 'line(1000)' },
  PlanOutcome: { name: 'Name', help: 'line(1000)' },
  PlanTemplate: { name: 'Name', kind: 'word(actor|computation|supervisor)', help: 'line(1000)', icon: 'line(8192)', inputs: '[PlanInput; 256]', outputs: '[PlanOutput; 256]', outcomes: '[PlanOutcome; 256]', period_ms: 'number', starts: '[Name; 64]' },
  PlanToolbox: { name: 'Name', help: 'line(1000)', templates: '[PlanTemplate; 1000]' },
  PlanVariable: { name: 'Name', type: 'word(bool|int|float|string|object)', value: 'json', unit: 'line(32)' },
  PlanSetting: { level: 'int(0..63)', name: 'Name', value: 'json' },
  PlanSupervisor: { name: 'Name', global: 'bool', watching: 'bool', events: '[Name; 64]' },
  PlanCount: { is: 'word(actor|supervisor)', name: 'Name', times: 'number', seconds: 'number', last: 'number' },
  PlanTaken: { number: 'number', is: 'word(start|state|event)', element: 'line(128)', outcome: 'line(128)', target: 'line(128)' },
  PlanLevel: { path: 'line(4096)', doc: 'Doc', actor: 'line(128)', template: 'line(128)', activation: 'number', since: 'number', inputs: 'json', variables: '[PlanVariable; 1000]', supervisors: '[PlanSupervisor; 1000]', counts: '[PlanCount; 2000]', taken: 'PlanTaken?' },
  TryChoice: { path: 'line(4096)', element: 'line(128)', outcome: 'line(128)', out: '[TryValue; 1000]?' },
  TryValue: { name: 'line(128)', value: 'json' },
  TryOutput: { name: 'line(128)', type: 'word(bool|int|float|string|object)?' },
  TryWait: { path: 'line(4096)', actor: 'line(128)', states: '[line(128); 1000]', outputs: '[TryOutput; 1000]' },
  TryRaise: { path: 'line(4096)', supervisor: 'line(128)', events: '[line(128); 1000]' },
  TryTurn: { path: 'line(4096)', actor: 'line(128)', from: 'number', to: 'number?', end: 'line(260)?', interrupted: 'bool?' },
  TriedPlan: { state: 'word(none|running|paused|ended)', doc: 'Doc?', t: 'number', result: 'word(OK|Interrupted|Error)?', message: 'text(2000)?', levels: '[PlanLevel; 64]', story: '[Line; 200]' },
  PlanDifference: { kind: 'word(added|removed|changed|reordered)', element: 'text(100000)', part: 'text(100000)', path: '[text(100000); 16]', before: 'json?', after: 'json?', behind: 'text(100000)?' },
  GitVersion: { revision: 'line(64)', when_wall: 'number', by: 'line(100)', subject: 'line(200)' },
  KeptRecording: { path: 'Path', number: 'number', bytes: 'number', when_wall: 'number' },
  PlanChange: { number: 'number', t: 'number', state: 'word(taken|refused)', docs: '[Doc; 100]', reasons: '[text(2000); 1000]' },
  CodeMark: { keys: '[line(256); 16]', first: 'int(1..10000000)', last: 'int(1..10000000)' },
  FormulaWord: { name: 'line(64)', is: 'word(function|operator|constant)', form: 'line(100)', help: 'line(400)' },
  JsonStep: { do: 'word(set|remove|insert|move)', at: '[json; 100]', value: 'json?', text: 'text(2097152)?', to: 'int(0..1000000)?' },
  Project: { folder: 'line(1024)', name: 'line(200)', help: 'text(2000)', bare: 'bool?', copy_of: 'line(64)?', recording: 'Path?', plan: 'Path?', world: 'Path?', world_changed: 'bool?', scripts: '[Path; 200]', target: 'line(256)', border: 'line(1024)?' },
  FolderEntry: { name: 'line(512)', kind: 'word(folder|project|script|plan|world|recording)' },
  SharedFile: { path: 'Path', events: '[Definition; 65536]', constants: '[Definition; 65536]' },
  ListingLine: { line: 'int(0..10000000)', address: 'int(0..65535)', words: 'int(1..65535)', text: 'line(200)' },
  Failed: { node: 'NodeId', why: 'text(2000)' },
  NodeNote: { node: 'NodeId', what: 'text(2000)' },
  RunEnd: { number: 'number', t: 'number', wall: 'number', by: 'line(100)', why: 'word(stop|plan|error|died|signal|target|project|version|alone|slept)', result: 'word(OK|Interrupted|Error)?', message: 'text(2000)?', nodes: '[StopNode; 1024]' },
  DeployFile: { path: 'Path', size: 'int(0..16777216)', sha256: 'line(64)' },
  Deployed: { version: 'int(0..4294967295)', name: 'line(200)', when_wall: 'number?', current: 'bool' },
  FleetRobot: { connection: 'word(online|offline|lost|unknown)', age: 'word(fresh|waiting|stale)', state: 'word(running|paused|stopped|fault)?', actor: 'line(1000)?', since_wall: 'number?', told_wall: 'number?', problems: '[line(1000); 10]?', left_out: 'number?', project: 'line(1000)?', vagus: 'line(1000)?', plan: 'line(1000)?', groups: '[line(64); 32]?', nodes: '[line(64); 128]?', hear: '[line(64); 256]?', studio: 'line(1000)?' },
  FleetOutcome: { robot: 'line(64)', result: 'word(done|refused|silent|away)', what: 'text(10000)' },
  RolloutRobot: { at: 'int(0..9999)', is: 'word(later|wanted|started|well|failed)', why: 'text(2000)', has: 'bool' },
  FleetEvent: { number: 'number', wall: 'number', kind: 'word(event|connection|order)', robot: 'line(100)', name: 'line(64)', args: 'Words', text: 'text(2000)' },
  Asked: { client: 'int(1..1000000000)', name: 'line(100)', until_wall: 'number' },
};
export const commandTable: Readonly<Record<CommandName, { may: 'any' | 'look' | 'drive' | 'driver'; kind: CommandKind; out: Fields }>> = {
  'hello': { may: 'any', kind: 'look', out: { version: 'line(64)', epoch: 'line(32)', client: 'line(64)', now: 'number', role: 'word(drive|look)', number: 'int(1..1000000000)', driver: 'bool', wall: 'number', stops: 'int(0..9007199254740991)?' } },
  'watch': { may: 'look', kind: 'look', out: {} },
  'unwatch': { may: 'look', kind: 'look', out: {} },
  'stop': { may: 'look', kind: 'stop', out: { stood: '[NodeId; 1024]', nodes: '[StopNode; 1024]' } },
  'end.acknowledge': { may: 'look', kind: 'edit', out: {} },
  'driver.ask': { may: 'drive', kind: 'edit', out: { driver: 'bool' } },
  'driver.answer': { may: 'driver', kind: 'edit', out: {} },
  'access.renew': { may: 'driver', kind: 'edit', out: { token: 'line(200)' } },
  'driver.leave': { may: 'driver', kind: 'edit', out: {} },
  'deploy.begin': { may: 'driver', kind: 'edit', out: {} },
  'deploy.part': { may: 'driver', kind: 'edit', out: {} },
  'deploy.commit': { may: 'driver', kind: 'act', out: { result: 'word(started|stopped|refused|rolled_back|waiting)', version: 'int(0..4294967295)', findings: '[Finding; 2000]', why: 'text(4000)?' } },
  'deploy.back': { may: 'driver', kind: 'act', out: { result: 'word(started|stopped|refused|rolled_back|waiting)', version: 'int(0..4294967295)', findings: '[Finding; 2000]', why: 'text(4000)?' } },
  'deploy.list': { may: 'look', kind: 'look', out: { versions: '[Deployed; 100]' } },
  'project.example': { may: 'driver', kind: 'edit', out: { path: 'line(1024)' } },
  'project.open': { may: 'driver', kind: 'edit', out: { path: 'line(1024)' } },
  'project.new': { may: 'driver', kind: 'edit', out: { path: 'line(1024)' } },
  'project.make': { may: 'driver', kind: 'edit', out: { path: 'line(1024)' } },
  'project.close': { may: 'driver', kind: 'edit', out: {} },
  'project.forget': { may: 'driver', kind: 'edit', out: {} },
  'folder.list': { may: 'driver', kind: 'look', out: { path: 'line(1024)', parent: 'line(1024)', entries: '[FolderEntry; 2000]' } },
  'file.new': { may: 'driver', kind: 'edit', out: {} },
  'file.rename': { may: 'driver', kind: 'edit', out: { followed: '[Path; 100]' } },
  'file.delete': { may: 'driver', kind: 'edit', out: {} },
  'file.bytes': { may: 'look', kind: 'look', out: { base64: 'text(5592408)' } },
  'doc.open': { may: 'look', kind: 'look', out: { epoch: 'line(32)', text: 'text(2097152)', version: 'int(0..4294967295)', language: 'word(aesl|aesl-file|plan|world|toolbox|json|text)', unsaved: 'bool', ends: 'word(lf|crlf|mixed)' } },
  'doc.edit': { may: 'driver', kind: 'edit', out: { version: 'int(0..4294967295)', behind: '[Update; 1000]?', text: 'text(2097152)?', epoch: 'line(32)?' } },
  'doc.pull': { may: 'look', kind: 'look', out: { version: 'int(0..4294967295)', behind: '[Update; 1000]?', text: 'text(2097152)?', epoch: 'line(32)?' } },
  'doc.disk': { may: 'look', kind: 'look', out: { text: 'text(2097152)' } },
  'doc.patch': { may: 'driver', kind: 'edit', out: { version: 'int(0..4294967295)', text: 'text(2097152)' } },
  'doc.save': { may: 'driver', kind: 'edit', out: { version: 'int(0..4294967295)' } },
  'doc.save_all': { may: 'driver', kind: 'edit', out: { saved: '[Path; 2000]' } },
  'doc.revert': { may: 'driver', kind: 'edit', out: { version: 'int(0..4294967295)' } },
  'doc.keep': { may: 'driver', kind: 'edit', out: { version: 'int(0..4294967295)' } },
  'script.complete': { may: 'look', kind: 'look', out: { from: 'Place', items: '[Suggestion; 2000]' } },
  'script.hover': { may: 'look', kind: 'look', out: { found: 'bool', at: 'Place?', end: 'Place?', title: 'line(300)?', help: 'text(2000)?' } },
  'script.definition': { may: 'look', kind: 'look', out: { spots: '[Spot; 16]' } },
  'script.references': { may: 'look', kind: 'look', out: { name: 'line(200)', spots: '[Spot; 5000]' } },
  'script.rename': { may: 'driver', kind: 'edit', out: { changed: '[Doc; 2000]', places: 'int(0..100000)' } },
  'script.listing': { may: 'look', kind: 'look', out: { lines: '[ListingLine; 65536]' } },
  'script.add': { may: 'driver', kind: 'edit', out: { doc: 'Doc' } },
  'script.handlers': { may: 'look', kind: 'look', out: { spots: '[Spot; 1000]' } },
  'script.format_name': { may: 'look', kind: 'look', out: { good: 'bool', why: 'line(300)?' } },
  'text.search': { may: 'look', kind: 'look', out: { spots: '[Spot; 5000]', more: 'bool', why: 'line(300)?' } },
  'text.replace': { may: 'driver', kind: 'edit', out: { changed: '[Doc; 2000]', places: 'int(0..100000)' } },
  'plan.check': { may: 'look', kind: 'look', out: { findings: '[Finding; 2000]' } },
  'plan.code': { may: 'look', kind: 'look', out: { name: 'line(256)', text: 'text(4194304)', marks: '[CodeMark; 20000]', findings: '[Finding; 2000]' } },
  'template.new': { may: 'driver', kind: 'edit', out: { toolbox: 'line(256)', at: 'Place' } },
  'define.add': { may: 'driver', kind: 'edit', out: {} },
  'define.change': { may: 'driver', kind: 'edit', out: { places: 'int(0..100000)', others: '[Path; 2000]' } },
  'define.remove': { may: 'driver', kind: 'edit', out: {} },
  'define.move': { may: 'driver', kind: 'edit', out: {} },
  'target.choose': { may: 'driver', kind: 'act', out: {} },
  'target.leave': { may: 'driver', kind: 'edit', out: {} },
  'node.load': { may: 'driver', kind: 'act', out: { loaded: '[NodeId; 1024]', failed: '[Failed; 1024]' } },
  'fleet.open': { may: 'driver', kind: 'edit', out: {} },
  'fleet.close': { may: 'driver', kind: 'edit', out: {} },
  'fleet.order': { may: 'driver', kind: 'act', out: { outcomes: '[FleetOutcome; 10000]' } },
  'fleet.deploy': { may: 'driver', kind: 'act', out: {} },
  'fleet.rollback': { may: 'driver', kind: 'act', out: {} },
  'fleet.rollout_stop': { may: 'driver', kind: 'act', out: {} },
  'fleet.stop': { may: 'look', kind: 'stop', out: { outcomes: '[FleetOutcome; 10000]' } },
  'node.run': { may: 'driver', kind: 'act', out: { failed: '[Failed; 1024]' } },
  'node.pause': { may: 'driver', kind: 'stop', out: { failed: '[Failed; 1024]' } },
  'node.step': { may: 'driver', kind: 'act', out: { failed: '[Failed; 1024]' } },
  'node.stop': { may: 'driver', kind: 'stop', out: { failed: '[Failed; 1024]' } },
  'node.reset': { may: 'driver', kind: 'act', out: { failed: '[Failed; 1024]' } },
  'node.save': { may: 'driver', kind: 'act', out: { failed: '[Failed; 1024]', notes: '[NodeNote; 1024]' } },
  'break.set': { may: 'driver', kind: 'edit', out: { line: 'int(1..10000000)', note: 'line(300)?' } },
  'break.clear': { may: 'driver', kind: 'edit', out: {} },
  'variable.set': { may: 'driver', kind: 'act', out: {} },
  'event.send': { may: 'driver', kind: 'act', out: {} },
  'run.start': { may: 'driver', kind: 'act', out: {} },
  'run.pause': { may: 'driver', kind: 'stop', out: {} },
  'run.step': { may: 'driver', kind: 'act', out: {} },
  'run.continue': { may: 'driver', kind: 'act', out: {} },
  'run.reset': { may: 'driver', kind: 'act', out: {} },
  'run.end': { may: 'driver', kind: 'stop', out: {} },
  'clock.speed': { may: 'driver', kind: 'edit', out: {} },
  'plan.start': { may: 'driver', kind: 'act', out: {} },
  'plan.check_change': { may: 'look', kind: 'look', out: { runs: 'bool', reasons: '[text(2000); 1000]' } },
  'plan.differences': { may: 'look', kind: 'look', out: { version: 'int(0..4294967295)', before: 'text(4194304)', differences: '[PlanDifference; 20000]' } },
  'plan.versions': { may: 'look', kind: 'look', out: { versions: '[GitVersion; 30]' } },
  'plan.try': { may: 'look', kind: 'look', out: { plan: 'TriedPlan', waits: 'TryWait?', raises: '[TryRaise; 1000]', turns: '[TryTurn; 20000]', taken: '[number; 1000]', left: 'int(0..1000)' } },
  'plan.try.keep': { may: 'driver', kind: 'edit', out: { path: 'Path' } },
  'plan.pause': { may: 'driver', kind: 'stop', out: {} },
  'plan.continue': { may: 'driver', kind: 'act', out: {} },
  'plan.step': { may: 'driver', kind: 'act', out: {} },
  'plan.stop': { may: 'driver', kind: 'stop', out: {} },
  'plan.into': { may: 'driver', kind: 'act', out: { spots: '[Spot; 1000]' } },
  'plan.raise': { may: 'driver', kind: 'act', out: {} },
  'plan.held.go': { may: 'driver', kind: 'act', out: {} },
  'plan.held.step': { may: 'driver', kind: 'act', out: {} },
  'plan.held.drop': { may: 'driver', kind: 'act', out: {} },
  'plan.break.set': { may: 'driver', kind: 'edit', out: { number: 'number' } },
  'plan.break.clear': { may: 'driver', kind: 'edit', out: {} },
  'plan.set': { may: 'driver', kind: 'act', out: {} },
  'history.at': { may: 'look', kind: 'look', out: { run: 'number', t: 'number', to: 'number', plan: 'json?', before: 'number?', next: 'number?', values: '[HistoryWords; 256]', robots: '[json; 1024]', objects: '[json; 10000]', nodes: '[HistoryNode; 2048]', events: '[Happening; 2000]', exact: 'bool?', rays: 'text(1400000)?', picture: 'text(300000)?', picture_t: 'number?' } },
  'history.lanes': { may: 'look', kind: 'look', out: { run: 'number', from: 'number', to: 'number', lanes: '[HistoryLane; 600]', curves: '[HistoryCurve; 16]', loads: '[HistoryCurve; 64]', left_out: 'number' } },
  'history.ways': { may: 'look', kind: 'look', out: { run: 'number', ways: '[json; 1024]' } },
  'history.open': { may: 'look', kind: 'look', out: { from: 'number', to: 'number', lines: 'number', refused: 'number', plan: 'bool', robots: '[line(128); 1000]?', robot: 'line(128)?', scene: 'json?' } },
  'history.save': { may: 'driver', kind: 'edit', out: { path: 'Path' } },
  'recording.list': { may: 'look', kind: 'look', out: { recordings: '[KeptRecording; 100]' } },
  'recording.open': { may: 'driver', kind: 'act', out: { again: 'bool?', why: 'line(1000)?' } },
  'test.keep': { may: 'driver', kind: 'edit', out: { path: 'Path', differs: 'bool' } },
  'tests.run': { may: 'driver', kind: 'act', out: {} },
  'tests.stop': { may: 'driver', kind: 'edit', out: {} },
  'why.ask': { may: 'look', kind: 'look', out: { chain: '[WhyLink; 1001]' } },
  'turning.ask': { may: 'driver', kind: 'act', out: {} },
  'turning.stop': { may: 'driver', kind: 'edit', out: {} },
  'log.ask': { may: 'look', kind: 'look', out: { names: '[line(1000); 16]', hits: '[LogHit; 5000]', more: 'number', until: 'number', text: 'line(1000)' } },
  'runs.compare': { may: 'look', kind: 'look', out: { a: 'ComparedRun', b: 'ComparedRun', lanes: '[ComparedLane; 1000]', started: '[StartedApart; 1000]', scene: '[ComparedShape; 2000]' } },
  'log.cancel': { may: 'look', kind: 'look', out: {} },
  'world.move': { may: 'driver', kind: 'act', out: {} },
  'world.put': { may: 'driver', kind: 'act', out: { number: 'number' } },
  'world.take': { may: 'driver', kind: 'act', out: {} },
  'world.press': { may: 'driver', kind: 'act', out: {} },
  'world.tap': { may: 'driver', kind: 'act', out: {} },
  'world.light': { may: 'driver', kind: 'act', out: {} },
  'state.put': { may: 'driver', kind: 'edit', out: {} },
  'settings.put': { may: 'driver', kind: 'edit', out: {} },
};
export const topicTable: Readonly<Record<TopicName, { kind: 'document' | 'stream' | 'binary'; number?: number; is?: Fields; item?: string }>> = {
  'studio': { kind: 'document', is: { version: 'line(64)', driver: 'int(0..1000000000)', driver_name: 'line(100)', asked: 'Asked?', clients: 'int(0..1000)', project: 'Project?', serves: 'bool?', settings: 'json', recovered: '[Doc; 2000]' } },
  'start': { kind: 'document', is: { examples: '[Example; 200]', recent: '[Recent; 20]' } },
  'targets': { kind: 'document', is: { found: '[Found; 200]' } },
  'files': { kind: 'document', is: { files: '[FileEntry; 2000]', more: 'bool' } },
  'doc': { kind: 'document', is: { epoch: 'line(32)', version: 'int(0..4294967295)', language: 'word(aesl|aesl-file|plan|world|toolbox|json|text)', ends: 'word(lf|crlf|mixed)', unsaved: 'bool', by: 'line(64)', disk: 'bool', disk_hash: 'line(16)?', disk_no_text: 'line(1000)?', gone: 'bool', moved: 'Doc?' } },
  'findings': { kind: 'document', is: { findings: '[Finding; 2000]', more: 'int(0..1000000)', versions: '{int(0..4294967295); 2000}' } },
  'templates': { kind: 'document', is: { toolboxes: '[PlanToolbox; 200]', formulas: '[FormulaWord; 200]' } },
  'script': { kind: 'document', is: { version: 'int(0..4294967295)', good: 'bool', node: 'Name', for: 'line(200)', bytecode: 'Meter', variables: 'Meter', stack: 'Meter', handlers: '[Handler; 1000]', code_lines: '[int(1..10000000); 65536]' } },
  'scripts': { kind: 'document', is: { parts: '[ScriptPart; 1000]', files: '[SharedFile; 200]' } },
  'robot': { kind: 'document', is: { target: 'line(256)', name: 'line(256)', kind: 'word(none|simulator|bus)', state: 'word(none|connecting|connected|lost|failed)', why: 'text(1000)?', since_wall: 'number?', nodes: '[Node; 1024]', twins: '[line(300); 100]', load: 'number?', lost: 'number', events_a_second: 'number' } },
  'fleet': { kind: 'document', is: { state: 'word(none|connecting|connected|lost)', target: 'line(256)?', fleet: 'line(64)?', user: 'line(256)?', why: 'text(2000)?', robots: '{FleetRobot; 10000}' } },
  'rollout': { kind: 'document', is: { state: 'word(none|running|well|failed|left)', target: 'line(256)', project: 'line(200)?', version: 'line(200)', back: 'bool', by: 'line(100)', why: 'text(2000)', begun_wall: 'number', served: 'bool', robots: '{RolloutRobot; 10000}' } },
  'fleet_events': { kind: 'stream', item: 'FleetEvent' },
  'network': { kind: 'document', is: { links: '[Link; 256]', traffic: '[Traffic; 2000]' } },
  'node': { kind: 'document', is: { name: 'Name', variables: '[Variable; 4096]', events: '[LocalEvent; 256]', natives: '[Native; 512]' } },
  'breakpoints': { kind: 'document', is: { breakpoints: '[Breakpoint; 1000]', plans: '[PlanBreakpoint; 1000]' } },
  'clock': { kind: 'document', is: { t: 'number', wall: 'number', state: 'word(none|running|paused|ended|hanging|dead)', speed: 'number', real: 'number', why: 'text(2000)?' } },
  'end': { kind: 'document', is: { end: 'RunEnd?', open: 'bool' } },
  'plan': { kind: 'document', is: { state: 'word(none|running|paused|ended)', doc: 'Doc?', t: 'number', result: 'word(OK|Interrupted|Error)?', message: 'text(2000)?', stands_at: '[number; 1000]?', levels: '[PlanLevel; 64]', story: '[Line; 200]', change: 'PlanChange?' } },
  'history': { kind: 'document', is: { run: 'number', kind: 'word(none|simulated|bus|trace)', name: 'line(1024)', from: 'number', to: 'number', fine_from: 'number?', plan_from: 'number?', events_from: 'number?' } },
  'turning': { kind: 'document', is: { state: 'word(none|running|done|stopped|failed)', run: 'number?', condition: 'line(1000)?', tries: 'number?', progress: 'TurningProgress?', why: 'line(2000)?', result: 'Turning?' } },
  'tests': { kind: 'document', is: { state: 'word(none|running|done|stopped|failed)', why: 'line(2000)?', runs: 'number', done: 'number', failed: 'number', scripts: 'bool', tests: '[TestRun; 1000]', coverage: '[CoverageRow; 2000]', changed: '[Path; 2000]' } },
  'coverage': { kind: 'document', is: { changed: 'bool', plan: 'PlanCoverage?', lines: '[LineCoverage; 65536]?' } },
  'state': { kind: 'document', is: { values: 'json' } },
  'scene': { kind: 'document', is: { opening: 'number?', name: 'line(200)', size: '[number; 2]', open: 'bool', ground: 'Colour', image: 'Path?', robots: '[Robot; 1024]', objects: '[SceneObject; 4096]' } },
  'held': { kind: 'document', is: { stands: 'bool', events: '[HeldEvent; 200]', more: 'number', dropped: 'number' } },
  'happenings': { kind: 'stream', item: 'Happening' },
  'console': { kind: 'stream', item: 'Line' },
  'variables': { kind: 'binary', number: 1 },
  'samples': { kind: 'binary', number: 2 },
  'poses': { kind: 'binary', number: 3 },
  'rays': { kind: 'binary', number: 4 },
  'picture': { kind: 'binary', number: 5 },
};
