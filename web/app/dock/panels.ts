// The panels of the window. A new panel is one entry here: its name, its icon, and where its code is.
// The code is loaded when the panel is first seen.

import {
  IconAlertOctagon,
  IconBook2,
  IconBroadcast,
  IconBug,
  IconChartLine,
  IconEye,
  IconFolders,
  IconHelpCircle,
  IconList,
  IconListSearch,
  IconMap2,
  IconNetwork,
  IconPuzzle,
  IconSettings,
  IconTerminal2,
  IconTestPipe,
  IconTimeline,
  IconVariable,
  type TablerIcon,
} from '@tabler/icons-react';
import type { ComponentType } from 'react';
import { late } from '../parts/late';
import { text } from '../text';

export interface Panel {
  id: string;
  title: string;
  /** Pixels that it needs to be of use when someone asks for it. */
  least?: number;
  /** It opens beside the first of these that a layout holds, else with the documents; without it, with the problems. */
  like?: readonly string[];
  icon: TablerIcon;
  /** It shows the past when a person looks back. */
  past?: true;
  view: ComponentType;
  /** Buttons at the right of the panel's head. */
  tools?: ComponentType;
  /** Said in grey beside the title where the panel is alone. */
  subtitle?: ComponentType;
}

export const panels: readonly Panel[] = [
  {
    id: 'project',
    title: text.panels.project,
    icon: IconFolders,
    view: late(() => import('../panels/project_panel')),
  },
  {
    id: 'palette',
    like: ['project'],
    title: text.panels.palette,
    icon: IconPuzzle,
    view: late(() => import('../panels/palette_panel')),
  },
  {
    id: 'problems',
    title: text.panels.problems,
    icon: IconAlertOctagon,
    view: late(() => import('../panels/problems_panel')),
    tools: late(() => import('../panels/problems_tools'), 'button'),
  },
  {
    id: 'events',
    past: true,
    least: 180,
    like: ['watch', 'properties'],
    title: text.panels.events,
    icon: IconBroadcast,
    view: late(() => import('../panels/events/events_panel')),
    tools: late(() => import('../panels/events/events_tools'), 'button'),
  },
  {
    id: 'timeline',
    least: 220,
    title: text.panels.timeline,
    icon: IconTimeline,
    view: late(() => import('../panels/timeline/timeline_panel')),
    tools: late(() => import('../panels/timeline/timeline_tools'), 'button'),
  },
  {
    id: 'plots',
    past: true,
    least: 220,
    title: text.panels.plots,
    icon: IconChartLine,
    view: late(() => import('../panels/plots/plots_panel')),
    tools: late(() => import('../panels/plots/plots_tools'), 'button'),
  },
  {
    id: 'console',
    title: text.panels.console,
    icon: IconTerminal2,
    view: late(() => import('../panels/console_panel')),
  },
  {
    id: 'search',
    least: 220,
    title: text.panels.search,
    icon: IconListSearch,
    view: late(() => import('../panels/search_panel')),
  },
  {
    id: 'references',
    least: 220,
    title: text.panels.references,
    icon: IconList,
    view: late(() => import('../panels/references_panel')),
  },
  {
    id: 'variables',
    past: true,
    like: ['watch', 'properties'],
    title: text.panels.variables,
    icon: IconVariable,
    view: late(() => import('../panels/variables/variables_panel')),
  },
  {
    id: 'watch',
    past: true,
    like: ['variables', 'properties'],
    title: text.panels.watch,
    icon: IconEye,
    view: late(() => import('../panels/variables/watch_panel')),
  },
  {
    id: 'world',
    past: true,
    like: ['documents'],
    title: text.panels.world,
    icon: IconMap2,
    view: late(() => import('../panels/world_panel')),
    tools: late(() => import('../views/world/world_tools'), 'button'),
    subtitle: late(() => import('../views/world/world_name'), 'button'),
  },
  {
    id: 'properties',
    like: ['watch'],
    title: text.panels.properties,
    icon: IconBook2,
    view: late(() => import('../panels/properties_panel')),
  },
  {
    id: 'why',
    like: ['watch', 'properties'],
    least: 280,
    title: text.panels.why,
    icon: IconHelpCircle,
    view: late(() => import('../panels/why/why_panel')),
  },
  {
    id: 'runs',
    like: ['documents'],
    title: text.panels.runs,
    icon: IconTimeline,
    view: late(() => import('../panels/runs/runs_panel')),
  },
  {
    id: 'logs',
    least: 220,
    title: text.panels.logs,
    icon: IconList,
    view: late(() => import('../panels/logs/logs_panel')),
  },
  {
    id: 'tests',
    least: 240,
    title: text.panels.tests,
    icon: IconTestPipe,
    view: late(() => import('../panels/tests/tests_panel')),
  },
  {
    id: 'network',
    like: ['breakpoints'],
    least: 300,
    title: text.panels.network,
    icon: IconNetwork,
    view: late(() => import('../panels/network/network_panel')),
  },
  {
    id: 'breakpoints',
    title: text.panels.breakpoints,
    icon: IconBug,
    view: late(() => import('../panels/breakpoints_panel')),
  },
  {
    id: 'settings',
    like: ['documents'],
    title: text.panels.settings,
    icon: IconSettings,
    view: late(() => import('../panels/settings_panel')),
  },
];

export function panelOf(id: string): Panel | undefined {
  return panels.find((panel) => panel.id === id);
}
