// The named layouts of the window: which panel is where when a layout is opened first, in pixels.
// What a person makes of it is kept under the layout's name.

export const layoutNames = ['Draw', 'Script', 'Debug', 'Present'] as const;
export type LayoutName = (typeof layoutNames)[number];
export type DocumentKind = 'plan' | 'script' | 'world' | 'other';

export function isLayoutName(value: unknown): value is LayoutName {
  return layoutNames.some((name) => name === value);
}

/** Pixels in a window of 1400 to 1999, from 2000 on, and below 1400. None: it takes the rest. */
export interface Size {
  size?: number;
  wide?: number;
  narrow?: number;
}

/** Panels on top of each other. */
export type PanelArea = Size & { is: 'panels'; panels: readonly string[] };
/** Where documents of some kinds open; those of opens are there from the start. */
export type DocumentArea = Size & {
  is: 'documents';
  takes: readonly DocumentKind[];
  opens: readonly DocumentKind[];
  /** Behind the documents. */
  panels?: readonly string[];
};
/** Areas side by side or one under the other; the two alternate from level to level. */
export type Split = Size & { is: 'row' | 'column'; parts: readonly Box[] };
export type Box = PanelArea | DocumentArea | Split;

const left: PanelArea = { is: 'panels', panels: ['project'], size: 232, wide: 288 };
const all: readonly DocumentKind[] = ['plan', 'script', 'world', 'other'];
const dock = ['problems', 'events', 'timeline', 'plots', 'console'];

export const layoutPlans: Record<LayoutName, Split> = {
  Draw: {
    is: 'row',
    parts: [
      { ...left, panels: ['palette', 'project'] },
      {
        is: 'column',
        parts: [
          { is: 'documents', takes: all, opens: ['plan', 'world'] },
          { is: 'panels', panels: dock, size: 140, wide: 240, narrow: 88 },
        ],
      },
      {
        is: 'column',
        size: 296,
        wide: 376,
        parts: [
          { is: 'panels', panels: ['properties'] },
          { is: 'panels', panels: ['world'], size: 258, wide: 314, narrow: 184 },
        ],
      },
    ],
  },
  Script: {
    is: 'row',
    parts: [
      left,
      {
        is: 'column',
        parts: [
          { is: 'documents', takes: all, opens: ['script'] },
          {
            is: 'panels',
            panels: ['problems', 'search', 'timeline', 'plots', 'console'],
            size: 104,
            wide: 240,
            narrow: 88,
          },
        ],
      },
      {
        is: 'column',
        size: 360,
        wide: 440,
        narrow: 320,
        parts: [
          { is: 'panels', panels: ['variables', 'watch'] },
          { is: 'panels', panels: ['world', 'events'], size: 340, wide: 520, narrow: 268 },
        ],
      },
    ],
  },
  Debug: {
    is: 'column',
    parts: [
      {
        is: 'row',
        parts: [
          { is: 'documents', takes: ['plan'], opens: ['plan'], size: 636, wide: 1100, narrow: 460 },
          {
            is: 'column',
            parts: [
              { is: 'documents', takes: ['script', 'world', 'other'], opens: ['script'] },
              {
                is: 'panels',
                panels: ['breakpoints', 'network'],
                size: 176,
                wide: 240,
                narrow: 120,
              },
            ],
          },
          {
            is: 'column',
            size: 352,
            wide: 480,
            narrow: 320,
            parts: [
              { is: 'panels', panels: ['world'], size: 256, wide: 380, narrow: 184 },
              { is: 'panels', panels: ['watch', 'variables'] },
            ],
          },
        ],
      },
      {
        is: 'panels',
        panels: ['events', 'problems', 'timeline', 'plots', 'console'],
        size: 276,
        wide: 320,
        narrow: 180,
      },
    ],
  },
  // For a class or a talk: the plan and the world, large; letters are larger, too (look/present.css).
  Present: {
    is: 'row',
    parts: [
      { is: 'documents', takes: ['plan'], opens: ['plan'] },
      {
        is: 'column',
        size: 460,
        wide: 820,
        narrow: 360,
        parts: [{ is: 'panels', panels: ['world'] }],
      },
    ],
  },
};

/** In a window too small for panels on all sides: documents, and one column of panels beside them. */
export const smallPlans: Record<LayoutName, Split> = {
  Draw: smallPlan(['palette', 'project', 'properties', 'world'], ['plan', 'world'], dock),
  Script: smallPlan(
    ['variables', 'project', 'watch', 'world', 'events'],
    ['script'],
    ['problems', 'search', 'timeline', 'plots', 'console'],
  ),
  Debug: smallPlan(
    ['world', 'watch', 'variables', 'breakpoints', 'network'],
    ['plan', 'script'],
    ['events', 'problems', 'timeline', 'plots', 'console'],
  ),
  Present: {
    is: 'row',
    parts: [
      { is: 'documents', takes: ['plan'], opens: ['plan'] },
      { is: 'panels', panels: ['world'], size: 280 },
    ],
  },
};

/** In such a window that is high, as a tablet on its end: the panels share two places below the documents. */
export function tallPlan({ parts }: Split): Split {
  const panels = parts.flatMap((part) => (part.is === 'panels' ? part.panels : []));
  const isRight = (panel: string) => panel === 'world' || panel === 'events';
  const below = [panels.filter((panel) => !isRight(panel)), panels.filter(isRight)];
  return {
    is: 'column',
    parts: [
      ...parts.filter((part) => part.is === 'documents'),
      {
        is: 'row',
        size: 400,
        parts: below.flatMap((some) => (some.length > 0 ? { is: 'panels', panels: some } : [])),
      },
    ],
  };
}

function smallPlan(
  side: readonly string[],
  opens: readonly DocumentKind[],
  behind: readonly string[],
): Split {
  return {
    is: 'row',
    parts: [
      { is: 'panels', panels: side, size: 248 },
      { is: 'documents', takes: all, opens, panels: behind },
    ],
  };
}

/** A layout in a project without a plan or a world: nothing of it stays empty. The world takes the place of plans; without one, scripts do. */
export function filled(split: Split, has: { plan: boolean; world: boolean }): Split {
  const parts = split.parts.flatMap((part): Box[] => {
    if (part.is === 'documents') {
      const isEmpty = !has.plan && part.opens.every((kind) => kind === 'plan');
      if (!isEmpty) return [part];
      return has.world ? [] : [{ ...part, takes: all, opens: ['script'] }];
    }
    if (part.is === 'panels') {
      const panels = part.panels.filter((panel) => panel !== 'world' || has.world);
      return panels.length > 0 ? [{ ...part, panels }] : [];
    }
    const inner = filled(part, has);
    return inner.parts.length > 0 ? [inner] : [];
  });
  return { ...split, parts };
}

/** The kinds of documents that a layout opens by itself. */
export function kindsOpened(box: Box): readonly DocumentKind[] {
  if (box.is === 'panels') return [];
  return box.is === 'documents' ? box.opens : box.parts.flatMap(kindsOpened);
}

/** The pixels of the parts of a split that is so wide (or high) in a window of that width. */
export function sizesOf(parts: readonly Size[], total: number, windowWidth: number): number[] {
  const wanted = parts.map((part) => {
    if (part.size === undefined) return undefined;
    if (windowWidth >= 2000) return part.wide ?? part.size;
    return windowWidth < 1400 ? (part.narrow ?? part.size) : part.size;
  });
  return shared(wanted, total);
}

/** Sizes after the whole has changed: what takes the rest takes the change. */
export function resized(
  sizes: readonly number[],
  takesRest: readonly boolean[],
  total: number,
): number[] {
  const flexible = takesRest.some(Boolean) ? takesRest : takesRest.map(() => true);
  const rest = sizes.reduce((sum, size, index) => sum + (flexible[index] ? size : 0), 0);
  const fixed = sizes.reduce((sum, size, index) => sum + (flexible[index] ? 0 : size), 0);
  const left = Math.max(total - fixed, kSmallest);
  return sizes.map((size, index) =>
    flexible[index] ? (rest > 0 ? (size / rest) * left : left) : size,
  );
}

/** What takes the rest never gets less than this. */
const kSmallest = 120;

function shared(wanted: readonly (number | undefined)[], total: number): number[] {
  const fixed = wanted.reduce<number>((sum, size) => sum + (size ?? 0), 0);
  const open = wanted.filter((size) => size === undefined).length;
  const rest = Math.max(total - fixed, kSmallest) / Math.max(open, 1);
  return wanted.map((size) => size ?? rest);
}
