// A small picture of a world from above: its walls, what is in it, the robot and its way.

import pictures from './pictures.json';

interface Thing {
  kind: string;
  at: number[];
  size?: number[];
  radius?: number;
  angle?: number;
  colour?: number[];
}

export interface Picture {
  size: number[];
  things: Thing[];
  robots: { type: string; at: number[]; angle?: number }[];
  way: number[][];
}

const known = pictures as Record<string, Picture>;
const kWidth = 264;
const kHeight = 124;
const kBorder = 10;

export function WorldPicture({ example }: { example: string }) {
  const picture = known[example];
  if (!picture) return <PlanSketch />;
  const [width = 1, height = 1] = picture.size;
  const scale = Math.min((kWidth - 2 * kBorder) / width, (kHeight - 2 * kBorder) / height);
  const wall = 3 / scale;
  return (
    <svg className="thumb" viewBox={`0 0 ${kWidth} ${kHeight}`} aria-hidden="true">
      <g
        transform={`translate(${(kWidth - width * scale) / 2} ${(kHeight + height * scale) / 2}) scale(${scale} ${-scale})`}
      >
        <rect
          className="w-wall"
          x={-wall}
          y={-wall}
          width={width + 2 * wall}
          height={height + 2 * wall}
          rx={2 / scale}
        />
        <rect className="w-ground" width={width} height={height} />
        {picture.things.map((thing, index) => (
          <ThingShape key={index} thing={thing} />
        ))}
        {picture.way.length > 1 ? (
          <polyline
            className="w-trail"
            points={picture.way.map((point) => point.join(',')).join(' ')}
            strokeWidth={2 / scale}
          />
        ) : null}
        {picture.robots.map((robot, index) => (
          <RobotShape key={index} robot={robot} />
        ))}
      </g>
    </svg>
  );
}

/** An example without a world: a start, actors, the arrows between them. */
function PlanSketch() {
  const box = { width: 52, height: 30, rx: 5, fill: 'var(--surface-raised)' };
  return (
    <svg className="thumb" viewBox={`0 0 ${kWidth} ${kHeight}`} aria-hidden="true">
      <g fill="none" stroke="var(--action-arrow)" strokeWidth="2.5" strokeLinejoin="round">
        <path d="M62 35v42h18M132 77h20v-30h18M222 47h18v46h-82v-8" />
      </g>
      <g stroke="var(--border-hover)" strokeWidth="1.5">
        <rect x="36" y="22" {...box} height={20} rx={10} fill="var(--border-strong)" />
        <rect x="80" y="62" {...box} />
        <rect x="170" y="32" {...box} />
      </g>
      <rect x="80" y="62" {...box} fill="none" stroke="var(--active)" strokeWidth="2" />
    </svg>
  );
}

function ThingShape({ thing }: { thing: Thing }) {
  const [x = 0, y = 0] = thing.at;
  const [width = 0.1, height = 0.1] = thing.size ?? [];
  const fill = fillOf(thing);
  const turn = `translate(${x} ${y}) rotate(${((thing.angle ?? 0) * 180) / Math.PI})`;
  if (thing.radius !== undefined) return <circle cx={x} cy={y} r={thing.radius} {...fill} />;
  if (!thing.size) return <circle cx={x} cy={y} r={0.06} className="w-beacon" />;
  return (
    <rect transform={turn} x={-width / 2} y={-height / 2} width={width} height={height} {...fill} />
  );
}

/** Grey and brown things have the colours of the theme, others their own. */
function fillOf(thing: Thing): { className?: string; fill?: string } {
  const [red, green, blue] = thing.colour ?? [];
  if (red === undefined || green === undefined || blue === undefined)
    return { className: thing.kind === 'box' ? 'w-box' : 'w-stone' };
  if (
    thing.kind === 'wall' ||
    (thing.kind === 'cylinder' && Math.abs(red - green) < 0.1 && blue - red < 0.2)
  )
    return { className: 'w-stone' };
  if (thing.kind === 'box' && red > blue) return { className: 'w-box' };
  return { fill: `rgb(${[red, green, blue].map((part) => Math.round(part * 255)).join(' ')})` };
}

function RobotShape({ robot }: { robot: Picture['robots'][number] }) {
  const [x = 0, y = 0] = robot.at;
  const half = robot.type === 'carbot' ? 0.2 : robot.type === 'thymio2' ? 0.055 : 0.04;
  return (
    <g transform={`translate(${x} ${y}) rotate(${((robot.angle ?? 0) * 180) / Math.PI})`}>
      <rect
        className="w-robot"
        x={-half}
        y={-half * 0.88}
        width={2 * half}
        height={1.76 * half}
        rx={half * 0.4}
      />
      <circle className="w-eye" cx={half * 0.55} r={half * 0.38} />
    </g>
  );
}
