// Where a view's world comes from: the run, or the text of its file.

import { useCallback, useEffect, useRef, useState, useSyncExternalStore } from 'react';
import type { Doc, Path } from '../../../protocol/messages';
import type { JsonFile } from '../../../core/session/json_file';
import { folderOf, joinPath } from '../../../core/paths';
import { bytesOf, viewOf } from '../../../core/base64';
import type { Past } from '../../../core/past';
import type { Studio } from '../../../core/studio';
import { stageOfFile } from '../../../core/world/file';
import { posesThen, readPoses, readRays } from '../../../core/world/frames';
import { WorldModel } from '../../../core/world/model';
import { stageOfScene } from '../../../core/world/stage';
import { useDrives, usePart, useStudio, useTopic } from '../../hooks';
import { useMayAct, usePastTime, useScene } from '../../past_hooks';
import { FileActs } from './file_acts';
import { keptHand } from './kept_hand';
import { LiveActs } from './live_acts';
import { whyOf } from '../../../core/why';

/** Frames a second that are asked for; a slow page gets fewer. */
const kPosesRate = 30;

export function useWorldModel(): WorldModel {
  return useState(() => new WorldModel())[0];
}

/** Whether a world runs, or is at its start. */
export function useHasScene(): boolean {
  return (useScene()?.robots.length ?? 0) > 0;
}

/** Follows the running world while it is seen. */
export function useLive(model: WorldModel, on: boolean): void {
  const studio = useStudio();
  const drives = useMayAct();
  const scene = useScene(on);
  const world = useTopic('studio', {})?.project?.world;
  const looksBack = usePastTime() !== null;
  useEffect(() => {
    if (!on || !scene) return;
    if (scene.opening !== undefined)
      keptHand(studio).opened(`${studio.connection.life} ${scene.opening}`);
    model.setStage(stageOfScene(scene));
  }, [studio, model, on, scene]);
  useEffect(() => {
    if (on) model.allow(new LiveActs(studio, model, drives, () => Date.now()));
  }, [studio, model, on, drives]);
  useEffect(() => {
    if (!on) return;
    const { past, ways } = studio;
    model.show(ways.trails);
    const show = () => model.showThen(past.instant ? posesThen(past.instant) : null);
    const ends = [
      studio.connection.watch(
        'poses',
        {},
        {
          frame(t, payload) {
            ways.frame(t, model.robotKeys);
            model.setPoses(t, readPoses(payload));
          },
        },
        kPosesRate,
      ),
      past.changed.on(show),
      ways.changed.on(() => model.drawn.emit()),
    ];
    show();
    return () => ends.forEach((end) => end());
  }, [studio, model, on]);
  useEffect(() => {
    if (!on) return;
    const show = (payload: DataView) => model.setRays(readRays(payload));
    const end = looksBack ? watchThen(studio.past, show) : watchNow(studio, show);
    return () => {
      end();
      model.setRays({ looks: [], lamps: [] });
    };
  }, [studio, model, on, looksBack]);
  // As the world that was opened has it.
  useImage(model, on ? scene?.image : undefined, world, scene?.opening ?? 0);
}

function watchNow({ connection }: Studio, show: (rays: DataView) => void): () => void {
  return connection.watch('rays', {}, { frame: (_t, payload) => show(payload) }, kPosesRate);
}

function watchThen(past: Past, show: (rays: DataView) => void): () => void {
  const told = () => past.instant?.rays !== undefined && show(viewOf(past.instant.rays));
  const ends = [past.changed.on(told), past.wants({ rays: true })];
  told();
  return () => ends.forEach((end) => end());
}

/** Shows the file as its text says, also while nothing runs. */
export function useFileStage(
  model: WorldModel,
  file: JsonFile | null,
  doc: Doc,
  edits = true,
): void {
  const drives = useDrives() && edits;
  const [image, setImage] = useState<string | null>(null);
  useEffect(() => {
    if (!file) return;
    const show = () => {
      const stage = stageOfFile(file.value);
      model.setStage(stage);
      setImage(stage.image);
    };
    model.allow(new FileActs(file, model, drives, () => Date.now()));
    show();
    return file.changed.on(show);
  }, [model, file, drives]);
  const shown = file && image !== null ? resolved(folderOf(doc), image) : null;
  const size = usePart('files', {}, (is) => is?.files.find((one) => one.path === shown)?.size);
  useImage(model, file ? (image ?? undefined) : undefined, doc, size ?? 0);
}

/** A JSON file, open for edits by its members while wanted. */
export function useJsonFile(doc: Doc | null): { file: JsonFile | null; failed: string | null } {
  const studio = useStudio();
  const [file, setFile] = useState<JsonFile | null>(null);
  const [failed, setFailed] = useState<string | null>(null);
  const [moves, setMoves] = useState(0);
  // A file that was renamed to this name is another one than what was open under it.
  useEffect(
    () => studio.documents.moved.on(({ to }) => to === doc && setMoves((before) => before + 1)),
    [studio, doc],
  );
  useEffect(() => {
    if (doc === null) return;
    let gone = false;
    const held = studio.documents.acquire(doc);
    held.opened.then(
      (opened) => {
        if (gone) return;
        setFailed(null);
        setFile(opened.file());
      },
      (problem: unknown) => setFailed(whyOf(problem)),
    );
    return () => {
      gone = true;
      held.release();
      setFile(null);
    };
  }, [studio, doc, moves]);
  return { file, failed };
}

/** Why the text of a file is no JSON now. */
export function useBroken(file: JsonFile | null): string | null {
  return useSyncExternalStore(
    useCallback((listener: () => void) => file?.changed.on(listener) ?? (() => {}), [file]),
    () => file?.broken ?? null,
  );
}

/** The picture on the ground; its path counts from the folder of the world. Another version is read again. */
function useImage(
  model: WorldModel,
  image: string | undefined,
  world: Path | undefined,
  version: number,
): void {
  const { connection } = useStudio();
  const wanted = useRef('');
  useEffect(() => {
    const path = image && world ? resolved(folderOf(world), image) : null;
    const wish = (wanted.current = `${path} ${version}`);
    if (path === null) return model.cover(null);
    const show = (bitmap: ImageBitmap | null) => {
      if (wanted.current === wish) model.cover(bitmap);
    };
    connection
      .send('file.bytes', { path })
      .then(({ base64 }) => bitmapOf(base64))
      // Without it the ground has its colour; the checker says that the file is missing.
      .then(show, () => show(null));
  }, [connection, model, image, world, version]);
}

function resolved(folder: Path, path: string): Path {
  const parts: string[] = [];
  for (const part of joinPath(folder, path).split('/'))
    if (part === '..') parts.pop();
    else if (part !== '.' && part !== '') parts.push(part);
  return parts.join('/');
}

async function bitmapOf(base64: string): Promise<ImageBitmap> {
  return createImageBitmap(new Blob([bytesOf(base64)], { type: 'image/png' }));
}
