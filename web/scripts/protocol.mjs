// Makes protocol/messages.ts from src/serve/protocol/protocol.json; with --check it only says whether
// the file is current.
import { readFileSync, writeFileSync } from 'node:fs';
import { runnerImport } from 'vite';

const source = new URL('../../src/serve/protocol/protocol.json', import.meta.url);
const target = new URL('../protocol/messages.ts', import.meta.url);
const { module: shapes } = await runnerImport(
  new URL('../protocol/shape.ts', import.meta.url).pathname,
);

const protocol = JSON.parse(readFileSync(source, 'utf8'));
const made = make(protocol);
if (process.argv.includes('--check')) {
  const current = readFileSync(target, 'utf8') === made;
  if (!current)
    console.error('web/protocol/messages.ts is older than protocol.json: run "npm run protocol"');
  process.exit(current ? 0 : 1);
}
writeFileSync(target, made);

function make(from) {
  const out = [
    '// Made from src/serve/protocol/protocol.json by scripts/protocol.mjs. Do not edit.',
    '',
    'export type Json = null | boolean | number | string | Json[] | { [key: string]: Json };',
    '',
    `export const format = ${quote(from.format)};`,
    'export const limits = {',
    ...Object.entries(from.limits).map(
      ([name, limit]) => `  /** ${limit.help} */\n  ${name}: ${limit.value},`,
    ),
    '} as const;',
    '',
  ];
  for (const [name, type] of Object.entries(from.types)) {
    out.push(`/** ${type.help} */`);
    if (type.fields) out.push(`export interface ${name} ${fieldsOf(type.fields)}`);
    else out.push(`export type ${name} = ${typeOf(shapes.readShape(type.is))};`);
    out.push('');
  }
  out.push(
    'export interface Commands {',
    ...Object.entries(from.commands).flatMap(commandOf),
    '}',
    '',
  );
  out.push('export interface Topics {', ...Object.entries(from.topics).flatMap(topicOf), '}', '');
  out.push(
    'export type CommandName = keyof Commands;',
    'export type TopicName = keyof Topics;',
    "export type TopicOf<K extends 'document' | 'stream' | 'binary'> = {",
    "  [T in TopicName]: Topics[T]['kind'] extends K ? T : never;",
    '}[TopicName];',
    '',
    "export type CommandKind = 'look' | 'edit' | 'act' | 'stop';",
    'type Fields = Readonly<Record<string, string>>;',
    '',
    '/** The same at run time, for the check of what arrives. */',
    'export const typeTable: Readonly<Record<string, string | Fields>> = {',
    ...Object.entries(from.types).map(
      ([name, type]) => `  ${name}: ${type.fields ? bare(type.fields) : quote(type.is)},`,
    ),
    '};',
    "export const commandTable: Readonly<Record<CommandName, { may: 'any' | 'look' | 'drive' | 'driver'; kind: CommandKind; out: Fields }>> = {",
    ...Object.entries(from.commands).map(
      ([name, c]) =>
        `  ${quote(name)}: { may: ${quote(c.may)}, kind: ${quote(c.kind)}, out: ${bare(c.out)} },`,
    ),
    '};',
    "export const topicTable: Readonly<Record<TopicName, { kind: 'document' | 'stream' | 'binary'; number?: number; is?: Fields; item?: string }>> = {",
    ...Object.entries(from.topics).map(
      ([name, t]) =>
        `  ${quote(name)}: { kind: ${quote(t.kind)}${t.number ? `, number: ${t.number}` : ''}${t.is ? `, is: ${bare(t.is)}` : ''}${t.item ? `, item: ${quote(t.item)}` : ''} },`,
    ),
    '};',
    '',
  );
  return out.join('\n');
}

function commandOf([name, command]) {
  return [
    `  /** ${command.help} */`,
    `  ${quote(name)}: { in: ${fieldsOf(command.in, '  ')}; out: ${fieldsOf(command.out, '  ')} };`,
  ];
}

function topicOf([name, topic]) {
  const parts = [`kind: ${quote(topic.kind)}`, `of: ${fieldsOf(topic.of ?? {}, '  ')}`];
  if (topic.is) parts.push(`is: ${fieldsOf(topic.is, '  ')}`);
  if (topic.item) parts.push(`is: ${topic.item}`);
  return [`  /** ${topic.help} */`, `  ${quote(name)}: { ${parts.join('; ')} };`];
}

function fieldsOf(fields, indent = '') {
  const rows = Object.entries(fields).map(([name, text]) => {
    const field = shapes.readField(text);
    const help = field.help ? `${indent}  /** ${field.help} */\n` : '';
    return `${help}${indent}  ${name}${field.optional ? '?' : ''}: ${typeOf(field.shape)};`;
  });
  return rows.length === 0 ? 'Record<never, never>' : `{\n${rows.join('\n')}\n${indent}}`;
}

function typeOf(shape) {
  switch (shape.is) {
    case 'text':
      return 'string';
    case 'number':
      return 'number';
    case 'bool':
      return 'boolean';
    case 'json':
      return 'Json';
    case 'word':
      return shape.words.map(quote).join(' | ');
    case 'list':
      return shape.of.is === 'word' ? `(${typeOf(shape.of)})[]` : `${typeOf(shape.of)}[]`;
    case 'table':
      return `Record<string, ${typeOf(shape.of)}>`;
    case 'named':
      return shape.name;
  }
}

function bare(fields) {
  const rows = Object.entries(fields).map(
    ([name, text]) => `${name}: ${quote(text.split(' -- ')[0])}`,
  );
  return `{ ${rows.join(', ')} }`.replace('{  }', '{}');
}

function quote(text) {
  return `'${text.replaceAll("'", "\\'")}'`;
}
