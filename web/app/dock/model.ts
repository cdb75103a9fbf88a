// The panels' model: made from a layout's plan, taken from what was kept, brought to a window's size.

import {
  Actions,
  Model,
  Orientation,
  type IJsonModel,
  type IJsonRowNode,
  type IJsonTabNode,
  type IJsonTabSetNode,
  type Node,
  RowNode,
  TabSetNode,
} from 'flexlayout-react';
import { resized, sizesOf, type Box, type DocumentKind, type Split } from '../../core/layouts';
import { text } from '../text';
import { panelOf } from './panels';

export interface Extent {
  width: number;
  height: number;
}

export interface NamedDoc {
  doc: string;
  name: string;
}

export interface AreaConfig {
  takes?: readonly DocumentKind[];
  /** It takes the rest of its row or column. */
  rest: boolean;
}

const global: IJsonModel['global'] = {
  tabSetEnableMaximize: false,
  tabSetEnableDeleteWhenEmpty: true,
  tabSetEnableSingleTabStretch: false,
  tabSetMinWidth: 120,
  tabSetMinHeight: 60,
  tabEnableRename: false,
  tabEnableScrollbars: false,
  enableEdgeDock: true,
};

/** The model of a layout as it is opened first; docs says which documents an area opens. */
export function makeModel(
  plan: Split,
  extent: Extent,
  docs: (kind: DocumentKind) => NamedDoc[],
): Model {
  const layout = rowOf(plan, extent, docs);
  return Model.fromJson({
    global: { ...global, rootOrientationVertical: plan.is === 'column' },
    borders: [],
    layout,
  });
}

/** The model that was kept, without documents that are gone; null if it cannot be read. */
export function keptModel(kept: unknown, exists: (doc: string) => boolean): Model | null {
  try {
    const model = Model.fromJson(structuredClone(kept) as IJsonModel);
    for (const [id, doc] of documentTabs(model))
      if (!exists(doc)) model.doAction(Actions.deleteTab(id));
    return model;
  } catch {
    return null;
  }
}

/** A layout that was kept before the project had what one of its areas is for lacks that area. */
export function lacksArea(
  model: Model,
  plan: Split,
  docs: (kind: DocumentKind) => NamedDoc[],
): boolean {
  const there: string[] = [];
  model.visitNodes((node) => {
    if (node instanceof TabSetNode) there.push(String(configOf(node).takes ?? ''));
  });
  const lacks = (box: Box): boolean =>
    box.is === 'row' || box.is === 'column'
      ? box.parts.some(lacks)
      : box.is === 'documents' && hasUse(box, docs) && !there.includes(String(box.takes));
  return lacks(plan);
}

export function panelTab(id: string): IJsonTabNode {
  return {
    type: 'tab',
    id: `panel:${id}`,
    name: panelOf(id)?.title ?? id,
    component: 'panel',
    config: { panel: id },
  };
}

export function documentTab(doc: string, name: string): IJsonTabNode {
  return { type: 'tab', id: `doc:${doc}`, name, component: 'document', config: { doc } };
}

/** Ids of the tabs that show documents, with their documents. */
export function documentTabs(model: Model): [string, string][] {
  const found: [string, string][] = [];
  model.visitNodes((node) => {
    if (node.getId().startsWith('doc:')) found.push([node.getId(), node.getId().slice(4)]);
  });
  return found;
}

/** Where a document of this kind opens: the area made for it, else where documents are, else the middle. */
export function areaFor(model: Model, kind: DocumentKind): TabSetNode | undefined {
  const areas: TabSetNode[] = [];
  model.visitNodes((node) => void (node instanceof TabSetNode && areas.push(node)));
  const takes = (area: TabSetNode) => configOf(area).takes;
  return (
    areas.find((area) => takes(area)?.includes(kind)) ??
    areas.find((area) => takes(area)) ??
    areas.find((area) => area.getChildren().some((tab) => tab.getId().startsWith('doc:'))) ??
    areas.find((area) => configOf(area).rest) ??
    areas[0]
  );
}

/** Where a panel opens that the layout does not hold: with its like, else where documents are. */
export function areaForPanel(model: Model, id: string): TabSetNode | undefined {
  const { like = ['problems'] } = panelOf(id) ?? {};
  const areas = like.map((one) => model.getNodeById(`panel:${one}`)?.getParent());
  return areas.find((area) => area instanceof TabSetNode) ?? areaFor(model, 'other');
}

/** Gives the area of a tab at least so many pixels of height, taken from what is above or below. */
export function growArea(model: Model, tab: string, least: number): void {
  const area = model.getNodeById(tab)?.getParent();
  const row = area?.getParent();
  if (!(area instanceof TabSetNode) || !(row instanceof RowNode)) return;
  const height = row.getRect().height;
  if (row.getOrientation() === Orientation.HORZ || height < least * 2) return;
  const parts = row.getChildren();
  const all = parts.reduce((sum, part) => sum + weightOf(part), 0);
  const sizes = parts.map((part) => (weightOf(part) / all) * height);
  const own = parts.indexOf(area);
  const missing = least - (sizes[own] ?? least);
  if (missing <= 0) return;
  const largest = sizes.indexOf(Math.max(...sizes));
  const next = sizes.map((size, index) =>
    index === own ? least : index === largest ? size - missing : size,
  );
  model.doAction(Actions.adjustWeights(row.getId(), next));
}

/** Panels keep their pixels when the window changes; the middle takes what is left. */
export function fitModel(model: Model, before: Extent, after: Extent): void {
  const root = model.getRootRow();
  if (root) fitRow(model, root, before, after);
}

function fitRow(model: Model, row: RowNode, before: Extent, after: Extent): void {
  const key = row.getOrientation() === Orientation.HORZ ? 'width' : 'height';
  const children = row.getChildren();
  const total = children.reduce((sum, child) => sum + weightOf(child), 0);
  const sizes = children.map((child) => (weightOf(child) / total) * before[key]);
  const next = resized(sizes, children.map(takesRest), after[key]);
  model.doAction(Actions.adjustWeights(row.getId(), next));
  children.forEach((child, index) => {
    if (!(child instanceof RowNode)) return;
    fitRow(model, child, { ...before, [key]: sizes[index] }, { ...after, [key]: next[index] });
  });
}

function weightOf(node: Node): number {
  return node instanceof RowNode || node instanceof TabSetNode ? node.getWeight() : 0;
}

function takesRest(node: Node): boolean {
  if (node instanceof TabSetNode) return configOf(node).rest;
  // A row goes with the rest if documents, or all of its parts, do.
  const parts = node.getChildren();
  return (
    parts.some(
      (part) =>
        part instanceof TabSetNode && configOf(part).takes !== undefined && configOf(part).rest,
    ) || parts.some((part) => part instanceof RowNode && takesRest(part))
  );
}

export function configOf(area: TabSetNode): AreaConfig {
  return (area.getConfig() as AreaConfig | undefined) ?? { rest: false };
}

function rowOf(
  split: Split,
  extent: Extent,
  docs: (kind: DocumentKind) => NamedDoc[],
): IJsonRowNode {
  const key = split.is === 'row' ? 'width' : 'height';
  const parts = split.parts.filter((part) => hasUse(part, docs));
  const sizes = sizesOf(parts, extent[key], window.innerWidth);
  const children = parts.map((part, index) =>
    boxOf(part, sizes[index] ?? 100, { ...extent, [key]: sizes[index] ?? 100 }, docs),
  );
  return { type: 'row', weight: 100, children };
}

/** An area for plans alone is left out of a project without one. */
function hasUse(box: Box, docs: (kind: DocumentKind) => NamedDoc[]): boolean {
  return box.is !== 'documents' || box.takes.length > 1 || box.takes.flatMap(docs).length > 0;
}

/** The world is beside other panels only where there is one. */
function shownPanels(
  panels: readonly string[],
  docs: (kind: DocumentKind) => NamedDoc[],
): readonly string[] {
  const others = panels.filter((panel) => panel !== 'world');
  return others.length > 0 && docs('world').length === 0 ? others : panels;
}

function boxOf(
  box: Box,
  weight: number,
  extent: Extent,
  docs: (kind: DocumentKind) => NamedDoc[],
): IJsonRowNode | IJsonTabSetNode {
  const rest = box.size === undefined;
  switch (box.is) {
    case 'panels': {
      const config: AreaConfig = { rest };
      const panels = shownPanels(box.panels, docs);
      return {
        type: 'tabset',
        weight,
        config,
        classNameTabStrip: 'strip',
        children: panels.map(panelTab),
      };
    }
    case 'documents': {
      const config: AreaConfig = { rest, takes: box.takes };
      const children = [
        ...box.opens.flatMap(docs).map(({ doc, name }) => documentTab(doc, name)),
        ...(box.panels ?? []).map(panelTab),
      ];
      return {
        type: 'tabset',
        weight,
        config,
        classNameTabStrip: 'strip strip--documents',
        enableDeleteWhenEmpty: false,
        name: text.regions.main,
        children,
      };
    }
    case 'row':
    case 'column':
      return { ...rowOf(box, extent, docs), weight };
  }
}
