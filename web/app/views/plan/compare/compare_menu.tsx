import { Menu } from '@mantine/core';
import { IconFileDiff } from '@tabler/icons-react';
import type { Doc } from '../../../../protocol/messages';
import { comparingOf, type Other } from '../../../../core/plan/comparing';
import { useChanges, usePart, useStudio, useTopic } from '../../../hooks';
import { kStroke } from '../../../parts/icons';
import { StudioMenu, WhyItem } from '../../../parts/menu';
import { useAsked } from '../../../use_asked';
import { compareWords as words } from './words';
import '../../../look/compare.css';

/** With which other version the plan is compared. */
export function CompareMenu({ doc }: { doc: Doc }) {
  const comparing = comparingOf(useStudio());
  useChanges(comparing.changed);
  const opened = comparing.menu === doc;
  return (
    <StudioMenu
      opened={opened}
      onChange={(open) => comparing.open(open ? doc : null)}
      button={
        <button
          type="button"
          className="btn btn--plain btn--small btn--icon"
          aria-label={words.menu}
          data-tip={words.menu}
        >
          <IconFileDiff size={14} stroke={kStroke} aria-hidden />
        </button>
      }
    >
      {opened ? <Versions doc={doc} onChoose={(other) => comparing.compare(doc, other)} /> : null}
    </StudioMenu>
  );
}

function Versions({ doc, onChoose }: { doc: Doc; onChoose(other: Other): void }) {
  const state = useTopic('plan', {})?.state;
  const files = useTopic('files', {})?.files ?? [];
  const others = files.filter(({ kind, path }) => kind === 'plan' && path !== doc);
  const runs = state === 'running' || state === 'paused';
  return (
    <div className="pversions">
      <Menu.Label>{words.with}</Menu.Label>
      <Menu.Item onClick={() => onChoose({ against: 'disk', name: words.names.disk })}>
        {words.disk}
      </Menu.Item>
      <WhyItem
        why={runs ? '' : words.notRuns}
        onClick={() => onChoose({ against: 'running', name: words.names.running })}
      >
        {words.running}
      </WhyItem>
      <Commits doc={doc} onChoose={onChoose} />
      {others.length === 0 ? null : <Menu.Label>{words.files}</Menu.Label>}
      {others.map(({ path }) => (
        <Menu.Item key={path} onClick={() => onChoose({ against: 'file', file: path, name: path })}>
          {path}
        </Menu.Item>
      ))}
    </div>
  );
}

function Commits({ doc, onChoose }: { doc: Doc; onChoose(other: Other): void }) {
  const saved = usePart('doc', { doc }, (is) => is?.unsaved);
  const answer = useAsked('plan.versions', { doc }, saved);
  const versions = answer === 'refused' ? [] : answer?.versions;
  return (
    <>
      <Menu.Label>{words.git}</Menu.Label>
      {versions && versions.length > 0 ? null : (
        <p className="menu__help pversions__none">{versions ? words.noGit : words.asksGit}</p>
      )}
      {versions?.map(({ revision, subject, by, when_wall }) => (
        <Menu.Item
          key={revision}
          rightSection={<span className="muted num">{revision.slice(0, 7)}</span>}
          onClick={() =>
            onChoose({ against: 'revision', revision, name: words.commit(subject, revision) })
          }
        >
          <span className="pversions__subject ellipsis">{subject}</span>
          <span className="menu__help">{`${dateOf(when_wall)}, ${by}`}</span>
        </Menu.Item>
      ))}
    </>
  );
}

const dateOf = (wall: number): string =>
  new Date(wall).toLocaleDateString('en-GB', { day: 'numeric', month: 'short', year: 'numeric' });
