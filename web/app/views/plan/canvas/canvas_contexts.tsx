import type { ReactNode } from 'react';
import type { PlanBoard } from '../../../../core/plan/board';
import { FieldsOf } from '../../../parts/use_draft';
import { DotsContext, useDots } from './break_dots';
import { DistanceContext, type Distance } from './distance';
import { LiveContext, useLiveStore } from './live_store';
import { NoteContext, useNoteActs } from './note_context';
import { ConnectContext, type Connect } from './use_connecting';

/** What the elements of a canvas know without being told by their nodes. */
export function CanvasContexts(props: {
  board: PlanBoard;
  drives: boolean;
  distance: Distance;
  connect: Connect | null;
  children: ReactNode;
}) {
  const { board, drives, distance, connect, children } = props;
  return (
    <LiveContext value={useLiveStore(board)}>
      <ConnectContext value={connect}>
        <NoteContext value={useNoteActs(board, drives)}>
          <FieldsOf value={board.doc}>
            <DotsContext value={useDots(board)}>
              <DistanceContext value={distance}>{children}</DistanceContext>
            </DotsContext>
          </FieldsOf>
        </NoteContext>
      </ConnectContext>
    </LiveContext>
  );
}
