import { useState } from 'react';
import { mistakeIn } from '../../../core/condition';
import type { Doc } from '../../../protocol/messages';
import { canLog, logAt } from '../../commands/log_values';
import { useStudio, useTopic } from '../../hooks';
import { Button } from '../../parts/button';
import { useTyped } from '../../parts/use_draft';
import { text } from '../../text';
import { whyOf } from '../../../core/why';
import '../../look/lists.css';

const words = text.editor;

export function BreakpointForm({ doc, line, onEnd }: { doc: Doc; line: number; onEnd(): void }) {
  const studio = useStudio();
  const there = useTopic('breakpoints', {})?.breakpoints.find(
    (one) => one.doc === doc && one.line === line,
  );
  const [condition, setCondition] = useState(there?.condition ?? '');
  const [ignore, setIgnore] = useState(String(there?.ignore ?? 0));
  const [enabled, setEnabled] = useState(there?.enabled ?? true);
  const [tried, setTried] = useState(false);
  const [refused, setRefused] = useState('');
  const wrong = mistakeIn(condition);
  const good = /^\d{1,6}$/.test(ignore) && wrong === '';
  const send = async () => {
    try {
      await studio.send('break.set', { doc, line, condition, ignore: Number(ignore), enabled });
    } catch (problem) {
      // A name that the script does not have: what was typed stays.
      return setRefused(whyOf(problem));
    }
    onEnd();
  };
  const save = () => {
    setTried(true);
    setRefused('');
    if (good) void send();
    return good;
  };
  const before = { condition: '', ignore: 0, enabled: true, ...there };
  const isTyped =
    condition !== before.condition ||
    ignore !== String(before.ignore) ||
    enabled !== before.enabled;
  useTyped(isTyped, save);
  return (
    <form className="form form--line" onSubmit={(event) => (event.preventDefault(), save())}>
      <label>
        {words.condition}
        <input
          className="field"
          autoFocus
          placeholder={words.conditionHint}
          value={condition}
          aria-invalid={tried && (wrong || refused) !== ''}
          spellCheck={false}
          onChange={(event) => (setCondition(event.target.value), setRefused(''))}
        />
      </label>
      <label className="form__short">
        {words.ignore}
        <input
          className="field num"
          inputMode="numeric"
          value={ignore}
          aria-invalid={!/^\d{1,6}$/.test(ignore)}
          onChange={(event) => setIgnore(event.target.value)}
        />
      </label>
      <label className="form__check">
        <input
          type="checkbox"
          checked={enabled}
          onChange={(event) => setEnabled(event.target.checked)}
        />
        {words.enabled}
      </label>
      {tried && (wrong || refused) ? (
        <p className="planform__why" role="alert">
          {wrong || refused}
        </p>
      ) : null}
      <div className="form__end">
        <Button
          kind="plain"
          disabled={!canLog(studio)}
          keys="Shift+F9"
          onClick={() => (void logAt(studio, { is: 'line', doc, line }), onEnd())}
        >
          {text.commands['past.log']}
        </Button>
        {there ? (
          <Button onClick={() => (studio.order('break.clear', { doc, line }), onEnd())}>
            {words.clear}
          </Button>
        ) : null}
        <Button kind="primary" type="submit">
          {text.outline.save}
        </Button>
      </div>
    </form>
  );
}
