import {
  Layout,
  TabNode,
  TabSetNode,
  type BorderNode,
  type IIcons,
  type ITabRenderValues,
  type ITabSetRenderValues,
} from 'flexlayout-react';
import { IconChevronDown, IconX } from '@tabler/icons-react';
import { Suspense, useCallback, useRef } from 'react';
import type { Studio } from '../../core/studio';
import { StudioContext, useStudio } from '../hooks';
import { kStroke } from '../parts/icons';
import { text } from '../text';
import { DocumentView } from '../views/document_view';
import { RunNote } from '../views/run_note';
import { DocumentTools } from './document_tools';
import { DocumentTitle, PanelTitle } from './tab_titles';
import { configOf } from './model';
import { panelOf } from './panels';
import { useDock } from './use_dock';

const words: Record<string, string> = {
  'flexlayout.ui.close.tab': text.dock.closeTab,
  'flexlayout.ui.maximize.tabset': text.dock.maximize,
  'flexlayout.ui.restore.tabset': text.dock.restore,
  'flexlayout.ui.overflow.menu.tooltip': text.dock.overflow,
  'flexlayout.ui.splitter': text.dock.splitter,
  'flexlayout.ui.error.rendering.component': text.dock.error,
  'flexlayout.ui.error.rendering.component.retry': text.dock.retry,
};

const icons: IIcons = {
  more: () => <IconChevronDown size={16} stroke={kStroke} aria-hidden />,
  close: <IconX size={12} stroke={kStroke} aria-hidden />,
};

/** The docked panels of the chosen layout. */
export function Dock() {
  const frame = useRef<HTMLDivElement>(null);
  const studio = useStudio();
  const { model, changed } = useDock(frame);
  const titleOf = useCallback(
    (node: TabNode, values: ITabRenderValues) => renderTab(studio, node, values),
    [studio],
  );
  return (
    <div className="dock" ref={frame}>
      {model ? (
        <Layout
          model={model}
          factory={contentOf}
          onRenderTab={titleOf}
          onRenderTabSet={renderTabSet}
          onTabSetPlaceHolder={placeHolder}
          onModelChange={changed}
          i18nTranslator={translate}
          icons={icons}
          realtimeResize
        />
      ) : null}
    </div>
  );
}

function translate(key: string): string {
  return words[key] ?? key;
}

function contentOf(node: TabNode) {
  const { doc, panel } = node.getConfig() as { doc?: string; panel?: string };
  const View = panel ? panelOf(panel)?.view : undefined;
  return (
    <div className="content" data-tab-content={node.getId()}>
      <Suspense fallback={null}>
        {doc !== undefined ? <DocumentView doc={doc} /> : View ? <View /> : null}
      </Suspense>
      {doc !== undefined ? <RunNote doc={doc} /> : null}
    </div>
  );
}

/** The list of tabs without room draws titles in a React root of its own: the studio is given to each. */
function renderTab(studio: Studio, node: TabNode, values: ITabRenderValues) {
  const { doc, panel } = node.getConfig() as { doc?: string; panel?: string };
  if (doc === undefined && !panel) return;
  const title = doc === undefined ? <PanelTitle id={panel ?? ''} /> : <DocumentTitle doc={doc} />;
  values.content = <StudioContext value={studio}>{title}</StudioContext>;
}

function renderTabSet(node: TabSetNode | BorderNode, values: ITabSetRenderValues) {
  if (!(node instanceof TabSetNode)) return;
  const shown = node.getSelectedNode();
  const config = (shown?.getConfig() ?? {}) as { doc?: string; panel?: string };
  const Tools = config.panel ? panelOf(config.panel)?.tools : undefined;
  if (config.doc !== undefined) values.buttons.push(<DocumentTools key="tools" doc={config.doc} />);
  if (Tools)
    values.buttons.push(
      <Suspense key="tools" fallback={null}>
        <Tools />
      </Suspense>,
    );
}

function placeHolder(node: TabSetNode) {
  return configOf(node).takes ? <p className="placeholder">{text.empty.documents}</p> : null;
}
