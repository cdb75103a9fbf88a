// The elements of a board as nodes of the canvas. A node that did not change stays the same object,
// so that only what changed is drawn again.

import type { Node } from '@xyflow/react';
import type { Finding } from '../../../../protocol/messages';
import { countsOf, type Counts } from '../../../../core/findings';
import { arrowId, supervisorKey, type Tag } from '../../../../core/plan/arrows';
import { pillKey, type PlanBoard } from '../../../../core/plan/board';
import { dataArrows } from '../../../../core/plan/data';
import {
  kStart,
  type Actor,
  type Note,
  type Supervisor,
  type Variable,
} from '../../../../core/plan/model';
import { eventRow, stateRow, type Box } from '../../../../core/plan/shape';
import { noteKey } from '../../../../core/plan/notes';
import type { Side } from '../../../../core/plan/route';
import { drawWords as words } from '../words';
import type { NoteNode } from './note';
import type { RowData } from './port';

export type StartNode = Node<{ side: Side; leads: string | null }, 'start'>;
export type ActorNode = Node<{ actor: Actor; rows: RowData[]; findings: Counts }, 'actor'>;
export type SupervisorNode = Node<
  { supervisor: Supervisor; rows: RowData[]; findings: Counts },
  'supervisor'
>;
export type PillNode = Node<{ variable: Variable; near: boolean }, 'pill'>;
export type TagNode = Node<{ is: Tag['is'] }, 'tag'>;
export type PlanNode = StartNode | ActorNode | SupervisorNode | PillNode | TagNode | NoteNode;

export class FlowNodes {
  private known = new Map<string, { key: string; node: PlanNode }>();

  of(board: PlanBoard, findings: readonly Finding[], drives: boolean): PlanNode[] {
    const made = [
      startNode(board, drives),
      ...supervisorNodes(board, kStart, findings),
      ...board.scene.actors.flatMap(({ name }) => [
        ...actorNode(board, name, findings, drives),
        ...supervisorNodes(board, name, findings),
      ]),
      ...pillNodes(board),
      ...board.drawing.tags.map(tagNode),
      ...board.notes.map((note) => noteNode(board, note, drives)),
    ];
    const now = new Map<string, { key: string; node: PlanNode }>();
    for (const node of made) {
      const key = JSON.stringify(node);
      const before = this.known.get(node.id);
      now.set(node.id, before?.key === key ? before : { key, node });
    }
    this.known = now;
    return [...now.values()].map((one) => one.node);
  }
}

function placed(box: Box) {
  const { x, y, width, height } = box;
  return { position: { x, y }, width, height };
}

function startNode(board: PlanBoard, drives: boolean): StartNode {
  const leads = board.model.first;
  return {
    id: kStart,
    type: 'start',
    ...placed(board.scene.start.box),
    draggable: drives,
    selected: board.selection.has(kStart),
    ariaLabel: words.startLabel(leads),
    data: { side: board.drawing.sides.get(arrowId(kStart, '')) ?? 'right', leads },
  };
}

function actorNode(
  board: PlanBoard,
  name: string,
  findings: readonly Finding[],
  drives: boolean,
): ActorNode[] {
  const actor = board.actor(name);
  const block = board.scene.actors.find((one) => one.name === name);
  if (!actor || !block) return [];
  const counts = countsOf(findings.filter((one) => one.element === name));
  return [
    {
      id: name,
      type: 'actor',
      ...placed(block.box),
      draggable: drives,
      selected: board.selection.has(name),
      ariaLabel: words.elementLabel(words.roles[actor.role], name, actor.template, counts.errors),
      data: {
        actor,
        rows: rowsOf(board, name, actor, stateRow),
        findings: counts,
      },
    },
  ];
}

function supervisorNodes(
  board: PlanBoard,
  owner: string,
  findings: readonly Finding[],
): SupervisorNode[] {
  const { start, actors } = board.scene;
  const block = [start, ...actors].find((one) => one.name === owner);
  return (block?.supervisors ?? []).map(({ supervisor, box }): SupervisorNode => {
    const key = supervisorKey(supervisor);
    const { name, template } = supervisor;
    const counts = countsOf(findings.filter((one) => one.element === name));
    return {
      id: key,
      type: 'supervisor',
      ...placed(box),
      draggable: false,
      selected: board.selection.has(key),
      ariaLabel: words.elementLabel(words.roles.supervisor, name, template, counts.errors),
      data: {
        supervisor,
        rows: rowsOf(board, key, supervisor, (index) => eventRow(supervisor, index)),
        findings: counts,
      },
    };
  });
}

function rowsOf(
  board: PlanBoard,
  source: string,
  element: Actor | Supervisor,
  yOf: (index: number) => number,
): RowData[] {
  return element.outcomes.map(({ name, target }, index) => {
    const id = arrowId(source, name);
    const leads = board.drawing.loose.some((one) => one.id === id) ? null : target;
    const side = board.drawing.sides.get(id) ?? 'right';
    return { id, outcome: name, target: leads, side, y: yOf(index) };
  });
}

function pillNodes(board: PlanBoard): PillNode[] {
  const element = board.element(board.selected);
  const used = new Set(element ? dataArrows(board.model, element).map((one) => one.variable) : []);
  return board.scene.pills.flatMap(({ name, box }) => {
    const key = pillKey(name);
    const variable = board.variable(key);
    if (!variable) return [];
    const node: PillNode = {
      id: key,
      type: 'pill',
      ...placed(box),
      draggable: false,
      selected: board.selection.has(key),
      ariaLabel: words.variableLabel(name, variable.type),
      data: { variable, near: used.has(name) },
    };
    return [node];
  });
}

function tagNode(tag: Tag): TagNode {
  return {
    id: `tag:${tag.id}`,
    type: 'tag',
    ...placed(tag.box),
    draggable: false,
    selectable: false,
    focusable: false,
    ariaLabel: words[tag.is],
    data: { is: tag.is },
  };
}

/** Behind everything else. */
function noteNode(board: PlanBoard, note: Note, drives: boolean): NoteNode {
  const [x, y] = note.at;
  const [width, height] = note.size;
  const key = noteKey(note.index);
  return {
    id: key,
    type: 'note',
    ...placed({ x, y, width, height }),
    zIndex: -1,
    draggable: drives,
    selected: board.selection.has(key),
    ariaLabel: words.noteLabel(note.text),
    data: { note },
  };
}
