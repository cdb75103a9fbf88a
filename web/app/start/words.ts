// Words of the start screen and of what it opens: apart from text.ts, as they come with it.

export const startWords = {
  help: 'Take an example, connect to a robot, or open your own folder. Nothing here needs a network.',
  examples: 'Take an example',
  examplesHelp: 'opens a copy and runs it in the simulator',
  all: 'All examples',
  fewer: 'Fewer',
  connect: 'Connect to a robot',
  noRobot: 'No robot found yet',
  noRobotHelp: 'Switch one on, or plug it in by USB. It appears here by itself.',
  address: 'Address',
  connectButton: 'Connect',
  simulator: 'Simulator',
  simulatorHelp: 'Carbot or Thymio II, no robot needed',
  startButton: 'Start',
  folder: 'Open a folder',
  folderHelp: 'A folder with plans, scripts or worlds. Files stay plain text.',
  open: 'Open…',
  newHelp: 'Or begin with an empty project for a robot.',
  new: 'New',
  recent: 'Recent',
  noRecent: 'Nothing opened yet',
  noRecentHelp: 'Your last ten folders and robots appear here.',
  forget: (name: string) => `Forget ${name}`,
  gone: 'no longer there',
};

export const folderWords = {
  title: 'Open a folder',
  up: 'Up',
  here: 'Open this folder',
  empty: 'Nothing in here that can be opened.',
  path: 'Folder',
  close: 'Cancel',
};

export const newProjectWords = {
  title: 'New project',
  name: 'Name',
  robot: 'Robot',
  begins: 'Begin with',
  plans: { small: 'A small plan', none: 'A nearly empty plan' },
  scripts: { none: 'A script', small: 'A script and a small plan' },
  make: 'Create',
  robots: { thymio2: 'Thymio II', carbot: 'Carbot', epuck: 'e-puck' },
};
