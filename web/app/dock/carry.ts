// A document that was opened in one layout is there in the next one, too.

import { Actions, DockLocation, TabSetNode, type Model } from 'flexlayout-react';
import type { Doc } from '../../protocol/messages';
import { kindsOpened, type Split } from '../../core/layouts';
import type { Studio } from '../../core/studio';
import { documentExists, documentsOf, kindOf, tabNameOf } from '../documents';
import { areaFor, configOf, documentTab, documentTabs } from './model';

/** A model and the plan it was made from. */
export interface Opened {
  model: Model;
  plan: Split;
}

/**
 * Adds to a layout what is open in the one before and would not be opened by that by itself, and what
 * was looked at; removes what was closed there.
 */
export function carryDocuments(
  studio: Studio,
  from: Opened,
  to: Opened,
  closed: ReadonlySet<Doc>,
): void {
  const own = defaultsOf(studio, to.plan);
  for (const [id, doc] of documentTabs(to.model))
    if (closed.has(doc) && !own.has(doc)) to.model.doAction(Actions.deleteTab(id));
  const shown = studio.window.getState().doc;
  const known = defaultsOf(studio, from.plan);
  for (const [, doc] of documentTabs(from.model))
    if ((doc === shown || !known.has(doc)) && documentExists(studio, doc))
      addBehind(studio, to, doc);
  if (shown !== null && kindsOpened(to.plan).includes(kindOf(shown))) select(to.model, shown);
}

function defaultsOf(studio: Studio, plan: Split): ReadonlySet<Doc> {
  return new Set(kindsOpened(plan).flatMap((kind) => documentsOf(studio, kind)));
}

function addBehind(studio: Studio, { model }: Opened, doc: Doc): void {
  const area = areaFor(model, kindOf(doc));
  // Where one only looks there is no place for documents.
  if (!area || !configOf(area).takes || model.getNodeById(`doc:${doc}`)) return;
  // Behind the other documents, before panels that share their area.
  const tabs = area.getChildren();
  const last = tabs.findLastIndex((tab) => tab.getId().startsWith('doc:'));
  const tab = documentTab(doc, tabNameOf(studio, doc));
  const isFirst = last < 0;
  model.doAction(Actions.addTab(tab, area.getId(), DockLocation.CENTER, last + 1, isFirst));
}

function select(model: Model, doc: Doc): void {
  const tab = model.getNodeById(`doc:${doc}`);
  const area = tab?.getParent();
  if (tab && area instanceof TabSetNode && area.getSelectedNode() !== tab)
    model.doAction(Actions.selectTab(tab.getId()));
}
