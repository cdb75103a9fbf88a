import fc from 'fast-check';
import { describe, expect, test, vi } from 'vitest';
import type { Finding, Json, JsonStep } from '../protocol/messages';
import { misfit } from '../protocol/check';
import { readField } from '../protocol/shape';
import { countsOf, ordered, sameFinding, stepIndex } from './findings';
import { identityOf, kIdBlock, tokenIn } from './identity';
import { applySteps } from './json_steps';
import { normalKey, pressedKeys, typesText, type KeyPress } from './keys';
import { resized, sizesOf } from './layouts';
import { badName, folderOf, partOf, shownName } from './paths';
import { rankCommands } from './rank';
import { Registry } from './registry';
import { readSettings } from './settings';
import { textDiff } from './text_diff';
import { treeRows } from './tree';
import { mentionedIn, readWords, valueText } from './values';

const press = (key: string, held: Partial<KeyPress> = {}): KeyPress => ({
  key,
  code: '',
  ctrlKey: false,
  shiftKey: false,
  altKey: false,
  metaKey: false,
  ...held,
});

describe('keys', () => {
  test('OneKeyHasOneSpelling', () => {
    expect(normalKey('shift+ctrl+f')).toBe('Ctrl+Shift+F');
    expect(pressedKeys(press('F', { ctrlKey: true, shiftKey: true }))).toContain('Ctrl+Shift+F');
  });
  test('AQuestionMarkIsMetWhereverItStandsOnTheKeyboard', () => {
    expect(pressedKeys(press('?', { shiftKey: true }))).toContain('?');
  });
  test('KeysWithoutControlAreForTextsWhereTextsAreTyped', () => {
    expect(['?', '/', '1', 'Shift+A'].map(typesText)).toEqual([true, true, true, true]);
    expect(['F9', 'Shift+F5', 'Ctrl+K', 'Alt+Enter', 'Escape'].map(typesText)).toEqual([
      false,
      false,
      false,
      false,
      false,
    ]);
  });
  const control = (key: string, code: string, more: Partial<KeyPress> = {}) =>
    pressedKeys(press(key, { code, ctrlKey: true, ...more }));
  const altGr = (name: string) => name === 'AltGraph';

  test('LettersAreMeantWithTheShiftThatIsHeld', () => {
    expect(control('Z', 'KeyZ', { shiftKey: true })).toEqual(['Ctrl+Shift+Z']);
    expect(control('?', 'Minus', { shiftKey: true })).toEqual(['Ctrl+Shift+?', 'Ctrl+?']);
  });
  // The key for z is where English keyboards have y, and the other way round.
  test('OnAGermanOrSwissKeyboardTheLetterCountsAndNotItsPlace', () => {
    expect(control('z', 'KeyY')).toEqual(['Ctrl+Z']);
    expect(control('y', 'KeyZ')).toEqual(['Ctrl+Y']);
    expect(control('Z', 'KeyY', { shiftKey: true })).toEqual(['Ctrl+Shift+Z']);
    expect(control('/', 'Digit7', { shiftKey: true })).toContain('Ctrl+/');
    expect(pressedKeys(press('è', { code: 'BracketLeft' }))).toEqual(['È']);
  });
  test('OnAFrenchKeyboardTheLetterCountsAndDigitsAreMetWithShift', () => {
    expect(control('z', 'KeyW')).toEqual(['Ctrl+Z']);
    expect(control('w', 'KeyZ')).toEqual(['Ctrl+W']);
    expect(control('1', 'Digit1', { shiftKey: true })).toContain('Ctrl+1');
  });
  test('OnACyrillicKeyboardThePlaceOfALetterCounts', () => {
    expect(control('я', 'KeyZ')).toEqual(['Ctrl+Я', 'Ctrl+Z']);
    expect(control('Я', 'KeyZ', { shiftKey: true })).toEqual(['Ctrl+Shift+Я', 'Ctrl+Shift+Z']);
  });
  test('WhatAltGrAndOptionTypeMeansNothing', () => {
    expect(pressedKeys(press('€', { code: 'KeyE', getModifierState: altGr }))).toEqual([]);
    const windows = { code: 'KeyE', ctrlKey: true, altKey: true, getModifierState: altGr };
    expect(pressedKeys(press('€', windows))).toEqual([]);
    // A browser that does not tell of AltGr.
    expect(pressedKeys(press('€', { code: 'KeyE' }))).toEqual(['€']);
    expect(pressedKeys(press('π', { code: 'KeyP', altKey: true }), true)).toEqual([]);
    expect(pressedKeys(press('Dead', { code: 'KeyN', altKey: true }), true)).toEqual([]);
    expect(pressedKeys(press('l', { code: 'KeyL', altKey: true }))).toEqual(['Alt+L']);
    expect(pressedKeys(press('F12', { altKey: true }), true)).toEqual(['Alt+F12']);
  });
  test('OnAppleKeyboardsControlAndOptionAreAlt', () => {
    const held = { ctrlKey: true, altKey: true };
    expect(pressedKeys(press('¬', { ...held, code: 'KeyL' }), true)).toEqual(['Alt+L']);
    expect(pressedKeys(press('ß', { ...held, code: 'KeyS' }), true)).toEqual(['Alt+S']);
    // On an Apple AZERTY keyboard the browser reports the letter of that layout.
    expect(pressedKeys(press('a', { ...held, code: 'KeyQ' }), true)).toEqual(['Alt+A']);
    const shifted = press('Dead', { ...held, shiftKey: true, code: 'KeyU' });
    expect(pressedKeys(shifted, true)).toEqual(['Alt+Shift+U']);
    expect(pressedKeys(press('[', { ...held, code: 'Digit5' }), true)).toEqual(['Ctrl+Alt+[']);
    expect(pressedKeys(press('l', { ...held, code: 'KeyL' }))).toEqual(['Ctrl+Alt+L']);
  });
  test('WhatRedoesNeverUndoesEvenIfNothingIsToRedo', () => {
    const registry = new Registry();
    const undo = { id: 'undo', title: '', group: '', keys: ['Ctrl+Z'], run: vi.fn() };
    const keys = ['Ctrl+Y', 'Ctrl+Shift+Z'];
    registry.add([undo, { ...undo, id: 'redo', keys, enabled: () => false, run: vi.fn() }]);
    const held = { ctrlKey: true, shiftKey: true };
    expect(registry.press(press('Z', { ...held, code: 'KeyZ' }), false)).toBe(false);
    expect(registry.press(press('Z', { ...held, code: 'KeyY' }), false)).toBe(false);
    expect(registry.press(press('y', { ctrlKey: true, code: 'KeyZ' }), false)).toBe(false);
    expect(undo.run).not.toHaveBeenCalled();
  });
});

describe('the registry of commands', () => {
  const make = (id: string, more: object = {}) => ({
    id,
    title: id,
    group: 'Run',
    run: vi.fn(),
    ...more,
  });
  test('AKeyRunsItsCommandUnlessItIsTyped', () => {
    const registry = new Registry();
    const help = make('help', { keys: ['?'] });
    registry.add([help]);
    expect(registry.press(press('?', { shiftKey: true }), true)).toBe(false);
    expect(registry.press(press('?', { shiftKey: true }), false)).toBe(true);
    expect(help.run).toHaveBeenCalledOnce();
  });
  test('WhatIsNotPossibleNowLeavesTheKeyToTheNext', () => {
    const registry = new Registry();
    const off = make('off', { keys: ['F10'], enabled: () => false });
    const on = make('on', { keys: ['F10'] });
    registry.add([on]);
    registry.add([off]);
    expect(registry.press(press('F10'), false)).toBe(true);
    expect(off.run).not.toHaveBeenCalled();
    expect(on.run).toHaveBeenCalledOnce();
  });
  test('AFailureIsToldAndNotThrown', async () => {
    const registry = new Registry();
    const told = vi.fn();
    registry.failed.on(told);
    registry.add([make('bad', { run: () => Promise.reject(new Error('no')) })]);
    expect(registry.run('bad')).toBe(true);
    await vi.waitFor(() => expect(told).toHaveBeenCalledOnce());
  });
  test('RemovedCommandsAreGone', () => {
    const registry = new Registry();
    registry.add([make('a')])();
    expect(registry.list()).toEqual([]);
  });
  test('ThePaletteFindsByLettersInOrderAndPrefersWholeWords', () => {
    const commands = [
      make('Layout Debug'),
      make('Upload to the node'),
      make('Reset the panels of this layout'),
    ];
    const found = rankCommands(commands, 'layout', () => true).map((one) => one.command.id);
    expect(found).toEqual(['Layout Debug', 'Reset the panels of this layout']);
    expect(rankCommands(commands, 'utn', () => true)[0]?.command.id).toBe('Upload to the node');
  });
  test('WhatIsTypedInOnePieceIsMeantAlsoIfItCannotBeDoneNow', () => {
    const commands = [make('World: add an infrared beacon'), make('World: redo')];
    const found = rankCommands(commands, 'World: red', (id) => id !== 'World: redo');
    expect(found.map((one) => one.command.id)).toEqual([
      'World: redo',
      'World: add an infrared beacon',
    ]);
  });
});

describe('texts', () => {
  test('ADifferenceLeadsFromOneTextToTheOther', () => {
    const line = fc.stringMatching(/^[ab]{0,4}$/);
    const whole = fc.array(line, { maxLength: 6 }).map((lines) => lines.join('\n'));
    fc.assert(
      fc.property(whole, whole, (before, after) => {
        let out = before;
        for (const one of textDiff(before, after).reverse())
          out = out.slice(0, one.from) + one.insert + out.slice(one.to);
        expect(out).toBe(after);
      }),
    );
  });
  test('ARenameInTwoLinesIsTwoSmallChanges', () => {
    expect(textDiff('a = foo\nb = 1\nc = foo', 'a = bar\nb = 1\nc = bar')).toHaveLength(2);
  });
});

describe('files', () => {
  const file = (path: string, kind: 'folder' | 'text' = 'text') => ({
    path,
    kind,
    size: 0,
    unsaved: false,
  });
  test('FoldersComeFirstAndClosedOnesHideWhatIsInThem', () => {
    const files = [file('b.txt'), file('a/x.txt'), file('a', 'folder')];
    expect(treeRows(files, new Set()).map((row) => row.path)).toEqual(['a', 'a/x.txt', 'b.txt']);
    expect(treeRows(files, new Set(['a'])).map((row) => row.path)).toEqual(['a', 'b.txt']);
  });
  test('AFolderThatIsNotListedIsShownAllTheSame', () => {
    expect(treeRows([file('a/b/x.txt')], new Set()).map((row) => [row.path, row.level])).toEqual([
      ['a', 1],
      ['a/b', 2],
      ['a/b/x.txt', 3],
    ]);
  });
  test('PartsAndNames', () => {
    expect(partOf('c/carbot.aesl#2')).toEqual({ file: 'c/carbot.aesl', part: 2 });
    expect(folderOf('c/carbot.aesl')).toBe('c');
    expect(shownName('w/hall.world.json')).toBe('hall.world');
    expect(
      ['', '..', 'a/b', '.x', 'ok.aesl', 'Größe 2.txt'].map((name) => badName(name) === ''),
    ).toEqual([false, false, false, false, true, true]);
  });
});

describe('panels', () => {
  test('PanelsKeepTheirPixelsAndTheMiddleTakesTheRest', () => {
    expect(resized([232, 848, 360], [false, true, false], 1280)).toEqual([232, 688, 360]);
  });
  test('SizesFollowTheWidthOfTheWindow', () => {
    const parts = [{ size: 232, wide: 288 }, {}];
    expect(sizesOf(parts, 1440, 1440)).toEqual([232, 1208]);
    expect(sizesOf(parts, 2560, 2560)).toEqual([288, 2272]);
  });
});

describe('findings', () => {
  const finding = (severity: 'error' | 'warning', doc: string, line: number): Finding => ({
    doc,
    severity,
    code: 'X',
    at: { line, column: 1 },
    end: { line, column: 2 },
    what: '',
    fixes: [],
  });
  const list = [finding('warning', 'a', 1), finding('error', 'b', 9), finding('error', 'b', 2)];
  test('ErrorsComeFirstThenPlaces', () => {
    expect(ordered(list).map((one) => `${one.doc}${one.at.line}`)).toEqual(['b2', 'b9', 'a1']);
    expect(countsOf(list, 'b')).toEqual({ errors: 2, warnings: 0 });
  });
  test('NextGoesRound', () => {
    expect([
      stepIndex(3, -1, 1),
      stepIndex(3, 2, 1),
      stepIndex(3, 0, -1),
      stepIndex(0, -1, 1),
    ]).toEqual([0, 0, 2, -1]);
  });
  test('AFixIsLookedUpAgainWhereItsFindingHasMovedTo', () => {
    const fixable = (line: number, label: string): Finding => ({
      ...finding('error', 'b', line),
      fixes: [{ label, edits: [] }],
    });
    const meant = fixable(9, 'add end');
    const now = [fixable(2, 'add end'), fixable(10, 'declare x'), fixable(12, 'add end')];
    expect(sameFinding(meant, 'add end', now)?.at.line).toBe(12);
    expect(sameFinding(meant, 'declare y', now)).toBeUndefined();
    expect(sameFinding({ ...meant, doc: 'a' }, 'add end', now)).toBeUndefined();
  });
});

describe('values of a node', () => {
  const variables = [
    { name: 'event.args', address: 2, size: 32, of: 'node' as const, writable: true },
    { name: 'token', address: 50, size: 1, of: 'script' as const, writable: true },
  ];
  test('WordsOfAFrameAndWhatALineNames', () => {
    const frame = new DataView(new ArrayBuffer(10));
    [3, 2].forEach((word, index) => frame.setUint16(index * 2, word, true));
    frame.setInt16(4, 164, true);
    frame.setInt16(6, -318, true);
    const words = new Map<number, number>();
    readWords(new DataView(frame.buffer, 0, 8), words);
    const named = mentionedIn('call drive.steer(event.args[1], event.args[2]) # token', variables);
    expect(named.map((one) => valueText(one, words))).toEqual([
      'event.args[1] = 164',
      'event.args[2] = -318',
    ]);
  });
  test('ATruncatedFrameIsReadAsFarAsItGoes', () => {
    const words = new Map<number, number>();
    fc.assert(
      fc.property(fc.uint8Array({ maxLength: 20 }), (bytes) =>
        readWords(new DataView(new Uint8Array(bytes).buffer), words),
      ),
    );
  });
});

describe('steps of a JSON file', () => {
  test('UndoLeadsBack', () => {
    const value: Json = { objects: [{ at: [1, 2] }, { at: [3, 4] }], name: 'Hall' };
    const steps: JsonStep[] = [
      { do: 'set', at: ['objects', 0, 'at', 1], value: 9 },
      { do: 'insert', at: ['objects', 1], value: {} },
      { do: 'move', at: ['objects', 0], to: 2 },
      { do: 'remove', at: ['name'] },
      { do: 'set', at: ['help'], value: 'x' },
    ];
    const done = applySteps(value, steps);
    expect(done.value).toEqual({ objects: [{}, { at: [3, 4] }, { at: [1, 9] }], help: 'x' });
    expect(applySteps(done.value, done.undo).value).toEqual(value);
  });
});

describe('what comes from outside', () => {
  test('SettingsOfAnotherKindAreTheDefaults', () => {
    expect(readSettings({ theme: 'pink', codeSize: 1e9, wrap: 'yes' })).toMatchObject({
      theme: 'system',
      codeSize: 12,
      wrap: false,
    });
    expect(readSettings(null).theme).toBe('system');
  });
  test('ATokenInTheFragment', () => {
    expect(['#token=abc', '#abc', '', '#x=1'].map(tokenIn)).toEqual(['abc', 'abc', '', '']);
  });
  test('AReloadGoesOnBehindTheNumbersThatWereUsed', () => {
    const kept = new Map<string, string>();
    const keep = {
      getItem: (key: string) => kept.get(key) ?? null,
      setItem: (key: string, value: string) => void kept.set(key, value),
    };
    const first = identityOf(keep, () => 'one');
    first.usedId(1);
    const second = identityOf(keep, () => 'two');
    expect([second.client, second.firstId]).toEqual(['one', kIdBlock + 2]);
  });
  test('TheCheckNamesThePlaceThatDoesNotFit', () => {
    const fields = { nodes: '[Node; 4]', why: 'text(10)?' };
    expect(misfit({ nodes: [] }, fields)).toBe('');
    expect(misfit({ nodes: [{ id: 'x' }] }, fields)).toBe('nodes.0.id');
    expect(misfit({ nodes: [], why: 3 }, fields)).toBe('why');
    expect(misfit([], fields)).toBe('no object');
  });
  test('TypesOfTheProtocolAreRead', () => {
    expect(readField('[int(-3..4); 600]? -- help')).toEqual({
      shape: { is: 'list', of: { is: 'number' } },
      optional: true,
      help: 'help',
    });
    expect(() => readField('florb(3)')).toThrow('is no type');
  });
});
