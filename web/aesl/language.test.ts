import {
  getIndentation,
  IndentContext,
  foldable,
  ensureSyntaxTree,
  indentUnit,
} from '@codemirror/language';
import { EditorState } from '@codemirror/state';
import { readFileSync } from 'node:fs';
import { describe, expect, test } from 'vitest';
import { aesl } from './language';
import { parser } from './parser';

const stateOf = (doc: string) => {
  const state = EditorState.create({ doc, extensions: [aesl(), indentUnit.of('    ')] });
  ensureSyntaxTree(state, doc.length, 5000);
  return state;
};

describe('the grammar of AESL', () => {
  test('KnowsWhatANameStandsFor', () => {
    const names: string[] = [];
    parser
      .parse(
        'const NEAR = 3\nvar a[NEAR]\nonevent tick\n  call math.fill(a, NEAR)\n  callsub go\n  emit done a\nsub go',
      )
      .iterate({
        enter: (node) =>
          void (
            /Name|Definition/.test(node.name) &&
            !/Name|Definition/.test(node.node.parent?.name ?? '') &&
            names.push(node.name)
          ),
      });
    expect(names).toEqual([
      'ConstantDefinition',
      'VariableDefinition',
      'ConstantName',
      'EventName',
      'NativeName',
      'VariableName',
      'ConstantName',
      'SubName',
      'EventName',
      'VariableName',
      'SubName',
    ]);
  });

  test('ReadsTheScriptsOfCarbotWithoutAHitch', () => {
    const file = readFileSync(
      new URL('../../examples/carbot/carbot.aesl', import.meta.url),
      'utf8',
    );
    for (const [, script = ''] of file.matchAll(/<!\[CDATA\[([\s\S]*?)\]\]>/g)) {
      let errors = 0;
      parser.parse(script).iterate({ enter: (node) => void (node.type.isError && errors++) });
      expect(errors).toBe(0);
    }
  });

  test('IndentsWhatStandsInABlockAndPullsBackItsEnd', () => {
    const state = stateOf('onevent tick\n    if a == 1 then\n        \n    end\n');
    const indent = (line: number) =>
      getIndentation(new IndentContext(state), state.doc.line(line).from);
    expect([indent(2), indent(3), indent(4)]).toEqual([4, 8, 4]);
  });

  test('FoldsAHandler', () => {
    const state = stateOf('onevent tick\n    a = 1\n    b = 2\nsub go\n');
    expect(foldable(state, 0, 12)).toEqual({ from: 12, to: 32 });
  });
});
