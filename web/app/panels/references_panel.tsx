import { useWindow } from '../hooks';
import { Quiet } from '../parts/blank';
import { text } from '../text';
import { Spots } from './spots';
import '../look/lists.css';
import { searchWords } from './search_words';

/** Where a name is used, as it was last asked. */
export default function ReferencesPanel() {
  const references = useWindow((state) => state.references);
  if (!references || references.spots.length === 0)
    return <Quiet>{text.editor.noDefinition}</Quiet>;
  return (
    <div className="finder">
      <p className="finder__note">
        {text.editor.references(references.name)} ·{' '}
        {searchWords.found(
          references.spots.length,
          new Set(references.spots.map((spot) => spot.doc)).size,
        )}
      </p>
      <Spots spots={references.spots} label={text.editor.references(references.name)} />
    </div>
  );
}
