import type { ReactNode } from 'react';
import { codeSizes, indentSizes, type Settings, type Theme } from '../../core/settings';
import { update } from '../../core/window_state';
import { useDrives, useSettings, useStudio, useTopic } from '../hooks';
import { KeysList } from '../parts/keys_list';
import { settingsWords } from './settings_words';
import '../look/lists.css';

const words = settingsWords;

export default function SettingsPanel() {
  const studio = useStudio();
  const drives = useDrives();
  const settings = useSettings();
  const version = useTopic('studio', {})?.version ?? '';
  const put = <K extends Exclude<keyof Settings, 'fleet'>>(key: K, value: Settings[K]) => (
    update(studio.window, (draft) => void (draft.theme = null)),
    studio.order('settings.put', { key, value })
  );
  const select = (
    key: 'codeSize' | 'spaces',
    values: number[],
    label: (value: number) => string,
  ) => (
    <select
      className="field field--ui"
      id={`set-${key}`}
      disabled={!drives}
      value={settings[key]}
      onChange={(event) => put(key, Number(event.target.value))}
    >
      {values.map((value) => (
        <option key={value} value={value}>
          {label(value)}
        </option>
      ))}
    </select>
  );
  const check = (key: 'showWords' | 'wrap') => (
    <button
      type="button"
      id={`set-${key}`}
      className="switch"
      role="switch"
      aria-checked={settings[key]}
      disabled={!drives}
      onClick={() => put(key, !settings[key])}
    />
  );
  return (
    <div className="scroll">
      <div className="settings">
        <h2>{words.title}</h2>
        <h3>{words.appearance}</h3>
        <Row id="set-theme" label={words.theme}>
          <select
            className="field field--ui"
            id="set-theme"
            disabled={!drives}
            value={settings.theme}
            onChange={(event) => put('theme', event.target.value as Theme)}
          >
            {Object.entries(words.themes).map(([theme, label]) => (
              <option key={theme} value={theme}>
                {label}
              </option>
            ))}
          </select>
        </Row>
        <h3>{words.editor}</h3>
        <Row id="set-codeSize" label={words.codeSize}>
          {select('codeSize', codeSizes, (value) => `${value} px`)}
        </Row>
        <Row id="set-spaces" label={words.spaces}>
          {select('spaces', indentSizes, words.spacesOf)}
        </Row>
        <Row id="set-showWords" label={words.words}>
          {check('showWords')}
        </Row>
        <Row id="set-wrap" label={words.wrap}>
          {check('wrap')}
        </Row>
        <h3>{words.keys}</h3>
        <KeysList />
        <h3>{words.about}</h3>
        <p className="settings__row">
          <span>{words.version}</span>
          <span className="num">{version}</span>
        </p>
        <p>
          <a href="licences.txt" target="_blank" rel="noreferrer">
            {words.licences}
          </a>
        </p>
      </div>
    </div>
  );
}

function Row({ id, label, children }: { id: string; label: string; children: ReactNode }) {
  return (
    <div className="settings__row">
      <label htmlFor={id}>{label}</label>
      {children}
    </div>
  );
}
