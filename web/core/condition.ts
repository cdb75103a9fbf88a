// Whether a condition can be one at all: values and operators in turn, brackets that close. What its names
// are, and whether its types fit, the server says; this is known while it is typed.

const kToken =
  /\s*(?:(?<value>\d[\w.]*|"[^"]*"|'[^']*')|(?<name>[A-Za-z_][\w.]*)|(?<operator>==|!=|<=|>=|<<|>>|[-+*/%&|^~<>])|(?<bracket>[()[\],]))/y;

interface State {
  /** A value must come; else an operator, a bracket or the end. */
  wantsValue: boolean;
  /** Brackets that are open, as they will be closed. */
  open: string[];
  /** The last token, '' at the start. */
  last: string;
  isName: boolean;
}

/** What is wrong with it, in a sentence; '' if nothing that is known here. An empty one is always true. */
export function mistakeIn(condition: string): string {
  const text = condition.trim();
  const state: State = { wantsValue: true, open: [], last: '', isName: false };
  for (let at = 0; at < text.length;) {
    kToken.lastIndex = at;
    const found = kToken.exec(text);
    if (!found) return `${text.slice(at).trim()}: expected a name, a number or an operator`;
    const wrong = take(state, found[0].trim(), found.groups ?? {});
    if (wrong) return wrong;
    at = kToken.lastIndex;
  }
  if (text === '') return '';
  if (state.wantsValue) return `expected a value after “${state.last}”`;
  return state.open.length > 0 ? `expected “${state.open.at(-1)}” at the end` : '';
}

/** The same of several, with commas between them. */
export function mistakeInList(values: string): string {
  for (const one of partsOf(values)) {
    const wrong = one.trim() === '' ? 'expected a value between commas' : mistakeIn(one);
    if (wrong) return wrong;
  }
  return '';
}

/** At commas outside of brackets and quotes. */
function partsOf(values: string): string[] {
  const parts = [''];
  let depth = 0;
  for (const token of values.match(/"[^"]*"|'[^']*'|[^]/g) ?? []) {
    if ('(['.includes(token)) depth++;
    if (')]'.includes(token)) depth--;
    if (token === ',' && depth <= 0) parts.push('');
    else parts.push((parts.pop() ?? '') + token);
  }
  return parts;
}

function take(state: State, token: string, is: Record<string, string | undefined>): string {
  const wrong =
    is['bracket'] !== undefined
      ? takeBracket(state, token)
      : is['operator'] !== undefined || /^(and|or|not)$/.test(token)
        ? takeOperator(state, token)
        : takeValue(state, token);
  state.isName = is['name'] !== undefined && !/^(and|or|not)$/.test(token);
  state.last = token;
  return wrong;
}

function takeValue(state: State, token: string): string {
  if (!state.wantsValue) return `expected an operator before “${token}”`;
  state.wantsValue = false;
  return '';
}

function takeOperator(state: State, token: string): string {
  const isUnary = token === 'not' || token === '~';
  if (state.wantsValue) return isUnary || token === '-' ? '' : `expected a value before “${token}”`;
  if (isUnary) return `expected an operator before “${token}”`;
  state.wantsValue = true;
  return '';
}

function takeBracket(state: State, token: string): string {
  if (token === '(' || token === '[') {
    // abs(x), list[2]: behind a name; else it is a value in brackets.
    if (token === '[' ? !state.isName : !state.wantsValue && !state.isName)
      return `expected an operator before “${token}”`;
    state.open.push(token === '(' ? ')' : ']');
    state.wantsValue = true;
    return '';
  }
  if (state.wantsValue) return `expected a value before “${token}”`;
  if (token === ',') {
    state.wantsValue = true;
    return state.open.length > 0 ? '' : 'expected no “,” here';
  }
  return state.open.pop() === token ? '' : `expected no “${token}” here`;
}
