// Where a view's world comes from: the run, or the text of its file.

import { useEffect, useMemo, useRef, useState, type RefObject } from 'react';
import type { Doc, Path } from '../../../protocol/messages';
import { JsonDocument } from '../../../core/json_document';
import { folderOf, joinPath } from '../../../core/paths';
import type { Studio } from '../../../core/studio';
import { stageOfFile } from '../../../core/world/file';
import { posesThen, readPoses, readRays } from '../../../core/world/frames';
import { WorldModel } from '../../../core/world/model';
import { stageOfScene } from '../../../core/world/stage';
import { useDrives, useStudio, useTopic } from '../../hooks';
import { useMayAct, usePastTime } from '../../past_hooks';
import { FileActs } from './file_acts';
import { LiveActs } from './live_acts';
import { useWorldOptions } from './options';

/** Frames a second that are asked for; a slow page gets fewer. */
const kPosesRate = 30;

export function useWorldModel(): WorldModel {
  return useMemo(() => new WorldModel(), []);
}

/** True while the element is on the screen. */
export function useVisible(frame: RefObject<HTMLElement | null>): boolean {
  const [visible, setVisible] = useState(false);
  useEffect(() => {
    if (!frame.current) return;
    const observer = new IntersectionObserver(([entry]) =>
      setVisible(entry?.isIntersecting ?? false),
    );
    observer.observe(frame.current);
    return () => observer.disconnect();
  }, [frame]);
  return visible;
}

/** Whether a world runs, or stands at its start. */
export function useHasScene(): boolean {
  return (useTopic('scene', {})?.robots.length ?? 0) > 0;
}

/** Follows the running world while it is seen. */
export function useLive(model: WorldModel, on: boolean): void {
  const studio = useStudio();
  const drives = useMayAct();
  const scene = useTopic('scene', on ? {} : null);
  const world = useTopic('studio', {})?.project?.world;
  const { rays } = useWorldOptions();
  // Nobody kept what a sensor looked at: the past is shown without.
  const looksBack = usePastTime() !== null;
  useEffect(() => {
    if (!on || !scene) return;
    model.setStage(stageOfScene(scene));
  }, [model, on, scene]);
  useEffect(() => {
    if (on) model.acts = new LiveActs(studio, model, drives);
  }, [studio, model, on, drives]);
  useEffect(() => {
    if (!on) return;
    const { past } = studio;
    const show = () => model.showThen(past.instant ? posesThen(past.instant) : null);
    const ends = [
      studio.connection.watch(
        'poses',
        {},
        { frame: (t, payload) => model.setPoses(t, readPoses(payload)) },
        kPosesRate,
      ),
      past.changed.on(show),
    ];
    show();
    return () => ends.forEach((end) => end());
  }, [studio, model, on]);
  useEffect(() => {
    if (!on || !rays || looksBack) return;
    const end = studio.connection.watch(
      'rays',
      {},
      { frame: (_t, payload) => model.setRays(readRays(payload)) },
      kPosesRate,
    );
    return () => {
      end();
      model.setRays({ looks: [], lamps: [] });
    };
  }, [studio, model, on, rays, looksBack]);
  useImage(model, on ? scene?.image : undefined, world);
}

/** Shows the file as its text says, also while nothing runs. */
export function useFileStage(
  model: WorldModel,
  file: JsonDocument | null,
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
    model.acts = new FileActs(file, model, drives, () => performance.now());
    show();
    return file.changed.on(show);
  }, [model, file, drives]);
  useImage(model, file ? (image ?? undefined) : undefined, doc);
}

/** The file of a world, open for edits by its members while wanted. */
export function useJsonDocument(doc: Doc | null): {
  file: JsonDocument | null;
  failed: string | null;
} {
  const studio = useStudio();
  const [file, setFile] = useState<JsonDocument | null>(null);
  const [failed, setFailed] = useState<string | null>(null);
  useEffect(() => {
    if (doc === null) return;
    let gone = false;
    let ends: (() => void)[] = [];
    openJson(studio, doc).then(
      (made) => {
        if (gone) return;
        setFailed(null);
        setFile(made);
        ends = [
          made.trouble.on((what) => studio.tell(what)),
          studio.documents.join(() => made.flushed()),
          studio.connection.watch('doc', { doc }, { value: (value) => made.told(asDoc(value)) }),
        ];
      },
      (problem: unknown) => setFailed(problem instanceof Error ? problem.message : String(problem)),
    );
    return () => {
      gone = true;
      ends.forEach((end) => end());
      setFile(null);
    };
  }, [studio, doc]);
  return { file, failed };
}

async function openJson(studio: Studio, doc: Doc): Promise<JsonDocument> {
  // What was typed as text a moment ago is part of it.
  await studio.documents.flushAll();
  const open = () => studio.send('doc.open', { doc });
  return new JsonDocument(
    {
      open,
      patch: (version, steps) => studio.send('doc.patch', { doc, version, steps }),
      edit: (version, changes) => studio.send('doc.edit', { doc, version, changes }),
    },
    await open(),
  );
}

type DocTopic = Parameters<JsonDocument['told']>[0];
// The connection has checked it against the topic.
function asDoc(value: unknown): DocTopic {
  return value as DocTopic;
}

/** The picture on the ground; its path counts from the folder of the world. */
function useImage(model: WorldModel, image: string | undefined, world: Path | undefined): void {
  const { connection } = useStudio();
  const shown = useRef<string | null>(null);
  useEffect(() => {
    const path = image && world ? resolved(folderOf(world), image) : null;
    shown.current = path;
    if (model.image) {
      model.image = null;
      model.drawn.emit();
    }
    if (path === null) return;
    connection
      .send('file.bytes', { path })
      .then(({ base64 }) => bitmapOf(base64))
      .then((bitmap) => {
        if (shown.current !== path) return;
        model.image = bitmap;
        model.drawn.emit();
      })
      // Without it the ground has its colour; the checker says that the file is missing.
      .catch(() => {});
  }, [connection, model, image, world]);
}

function resolved(folder: Path, path: string): Path {
  const parts: string[] = [];
  for (const part of joinPath(folder, path).split('/'))
    if (part === '..') parts.pop();
    else if (part !== '.' && part !== '') parts.push(part);
  return parts.join('/');
}

async function bitmapOf(base64: string): Promise<ImageBitmap> {
  const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
  return createImageBitmap(new Blob([bytes], { type: 'image/png' }));
}
