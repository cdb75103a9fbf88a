import { IconLetterCase, IconRegex, IconTextWrap } from '@tabler/icons-react';
import { useState } from 'react';
import type { Commands } from '../../protocol/messages';
import { toast } from '../../core/window_state';
import { useDrives, useStudio } from '../hooks';
import { Quiet } from '../parts/blank';
import { Button } from '../parts/button';
import { kStroke } from '../parts/icons';
import { text } from '../text';
import { Spots } from './spots';
import '../look/lists.css';
import { searchWords } from './search_words';

const words = searchWords;
type Query = Commands['text.search']['in'];
type Found = Commands['text.search']['out'] & { asked: Query };

/** Search and replace over all texts of the project. */
export default function SearchPanel() {
  const studio = useStudio();
  const drives = useDrives();
  const [query, setQuery] = useState<Query>({ text: '', regex: false, case: false, whole: false });
  const [by, setBy] = useState('');
  const [found, setFound] = useState<Found | null>(null);
  const search = async () => {
    if (query.text === '') return;
    await studio.documents.flushAll();
    setFound({ ...(await studio.send('text.search', query)), asked: query });
  };
  const replace = async () => {
    const { changed, places } = await studio.change('text.replace', { ...query, by });
    toast(studio.window, 'ok', words.replaced(places, changed.length));
    await search();
  };
  const attempt = (act: () => Promise<void>) =>
    void act().catch((problem: unknown) => studio.tell(problem));
  const docs = new Set(found?.spots.map((spot) => spot.doc)).size;
  return (
    <div className="finder">
      <form
        className="finder__bar"
        role="search"
        onSubmit={(event) => (event.preventDefault(), attempt(search))}
      >
        <input
          className="field"
          data-autofocus
          aria-label={words.find}
          placeholder={words.find}
          aria-invalid={found?.why !== undefined}
          value={query.text}
          spellCheck={false}
          onChange={(event) => setQuery({ ...query, text: event.target.value })}
        />
        <Toggles query={query} onChange={setQuery} />
        <Button type="submit">{words.go}</Button>
        <input
          className="field"
          aria-label={words.replace}
          placeholder={words.replace}
          value={by}
          spellCheck={false}
          onChange={(event) => setBy(event.target.value)}
        />
        <Button disabled={!drives || query.text === ''} onClick={() => attempt(replace)}>
          {words.replaceAll}
        </Button>
        {found && !found.why && found.spots.length > 0 ? (
          <span className="muted finder__count">{words.found(found.spots.length, docs)}</span>
        ) : null}
      </form>
      <Result found={found} />
    </div>
  );
}

function Result({ found }: { found: Found | null }) {
  if (!found) return <Quiet>{text.empty.search}</Quiet>;
  if (found.why) return <p className="quiet is-error">{found.why}</p>;
  if (found.spots.length === 0) return <Quiet>{text.empty.nothingFound(found.asked.text)}</Quiet>;
  return (
    <>
      <Spots spots={found.spots} label={words.results} />
      {found.more ? <Quiet>{words.more}</Quiet> : null}
    </>
  );
}

function Toggles({ query, onChange }: { query: Query; onChange(query: Query): void }) {
  const icon = { size: 14, stroke: kStroke };
  const toggle = (key: 'case' | 'whole' | 'regex', label: string, shape: React.ReactNode) => (
    <Button
      kind="plain"
      tip={label}
      icon={shape}
      aria-pressed={query[key]}
      className={query[key] ? 'is-on' : ''}
      onClick={() => onChange({ ...query, [key]: !query[key] })}
    />
  );
  return (
    <span className="topbar__tools">
      {toggle('case', words.case, <IconLetterCase {...icon} />)}
      {toggle('whole', words.whole, <IconTextWrap {...icon} />)}
      {toggle('regex', words.regex, <IconRegex {...icon} />)}
    </span>
  );
}
