// Projects that are heavy on purpose, for scripts/bench.mjs.
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';

const lines = (count, line) => Array.from({ length: count }, (_, index) => line(index));
const write = (folder, files) => {
  mkdirSync(folder, { recursive: true });
  for (const [name, content] of Object.entries(files))
    writeFileSync(
      join(folder, name),
      typeof content === 'string' ? content : JSON.stringify(content, null, 2),
    );
  return folder;
};
const project = (name) => ({
  'vagus.json': {
    format: 'vagus-project/1',
    name,
    scripts: ['all.aesl'],
    world: 'room.world.json',
    target: 'sim',
  },
});
const world = (robots, size) => ({
  format: 'vagus-world/1',
  name: 'Room',
  seed: 1,
  size,
  robots,
});

/** Of the script, all of them new 20 times a second; a Thymio has 69 more of its own. */
const kOwnVariables = 100;

const busy = (node) => `${lines(kOwnVariables, (i) => `var sensor${i} = ${i}`).join('\n')}
var turn
timer.period[0] = 50
motor.left.target = ${150 + node * 5}
motor.right.target = ${350 - node * 5}

# 20 times a second
onevent timer0
	turn = (turn + 1) % 1000
${lines(kOwnVariables, (i) => `\tsensor${i} = turn + ${i}`).join('\n')}
	emit beat [turn, motor.left.speed, motor.right.speed, prox.horizontal[2]]

onevent prox
	if prox.horizontal[2] &gt; 1500 then
		motor.left.target = 250
		motor.right.target = -250
	else
		motor.left.target = ${150 + node * 5}
		motor.right.target = ${350 - node * 5}
	end
`;

/** So many Thymios in a room, each with more than 100 variables, that drive and talk 20 times a second. */
export function crowd(folder, nodes) {
  const scripts = lines(nodes, (i) => `<node nodeId="${i + 1}" name="thymio-II">${busy(i)}</node>`);
  const robots = lines(nodes, (i) => ({
    name: `robot${i + 1}`,
    type: 'thymio2',
    node: i + 1,
    at: [0.4 + (i % 5) * 0.55, 0.4 + Math.floor(i / 5) * 0.55],
  }));
  return write(folder, {
    ...project('Crowd'),
    'all.aesl': `<!DOCTYPE aesl-source>
<network>
<event size="4" name="beat"/>
<keywords flag="true"/>
${scripts.join('\n')}
</network>
`,
    'room.world.json': world(robots, [3.1, 3.1]),
  });
}

/** A script of so many lines, at least 1,000, that just fits into a Thymio. */
export function longScript(folder, length) {
  const text = [
    // What a node holds is full with 850 lines: the rest is remarks.
    ...lines(length - 850, (i) => `# remark ${i}, as scripts have them`),
    ...lines(100, (i) => `const C${i} = ${i}`),
    ...lines(100, (i) => `var v${i}`),
  ];
  const handlers = ['timer0', 'timer1', 'prox', 'button.center', 'tap', 'acc', 'buttons', 'mic'];
  while (text.length < length) {
    if (text.length % 80 === 30 && handlers.length > 0) text.push(`onevent ${handlers.shift()}`);
    else text.push(`v${text.length % 100} = C${(text.length * 7) % 100}`);
  }
  return write(folder, {
    ...project('Long'),
    'all.aesl': `<!DOCTYPE aesl-source>
<network>
<keywords flag="true"/>
<node nodeId="1" name="thymio-II">${text.join('\n')}
</node>
</network>
`,
    'room.world.json': world(
      [{ name: 'thymio', type: 'thymio2', at: [0.5, 0.5], script: 'all.aesl' }],
      [2, 2],
    ),
  });
}

/** A plan of so many actors in a grid, each leading to the next and to one that is near; every third is watched. */
export function largePlan(folder, actors) {
  const columns = Math.ceil(Math.sqrt(actors));
  const name = (at) => `step${at % actors}`;
  const places = lines(actors, (at) => [
    name(at),
    [(at % columns) * 280, Math.floor(at / columns) * 220],
  ]);
  const made = lines(actors, (at) => [
    name(at),
    {
      template: 'Wait',
      in: { seconds: 1 },
      states: { Done: name(at + 1) },
      ...(at % 3 ? {} : { supervisors: { [`late${at}`]: late(name(at + columns)) } }),
    },
  ]);
  return write(folder, {
    'vagus.json': { format: 'vagus-project/1', name: 'Large', plan: 'Large.plan.json' },
    'Large.plan.json': {
      format: 'vagus-plan/1',
      name: 'Large',
      start: { actor: name(0) },
      actors: Object.fromEntries(made),
      layout: Object.fromEntries(places),
    },
  });
}

const late = (target) => ({
  template: 'Timeout',
  in: { seconds: 5 },
  events: { Timeout: target },
});
