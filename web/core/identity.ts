// Who this page is to the server: a name made once for each tab, and a counter of commands that a
// reload does not set back, so that no command is taken for an old one.

/** Numbers are reserved in blocks: the store is written once in so many commands. */
export const kIdBlock = 1000;

export interface Keep {
  getItem(key: string): string | null;
  setItem(key: string, value: string): void;
}

export interface Identity {
  client: string;
  /** Of this page load: a tab that was duplicated has the same name and another one of these. */
  nonce: string;
  firstId: number;
  usedId(id: number): void;
  /** The server has given the page another name. */
  renamed(client: string): void;
}

export function identityOf(keep: Keep, make: () => string): Identity {
  const client = keep.getItem('vagus.client') ?? make();
  keep.setItem('vagus.client', client);
  const firstId = Number(keep.getItem('vagus.ids') ?? '0') + 1;
  let reserved = firstId - 1;
  return {
    client,
    nonce: make(),
    firstId,
    renamed: (name) => keep.setItem('vagus.client', name),
    usedId(id) {
      if (id <= reserved) return;
      reserved = id + kIdBlock;
      keep.setItem('vagus.ids', String(reserved));
    },
  };
}

const kTokenKey = 'vagus.token';

/** A reload of this tab has it again. */
export function keepToken(keep: Keep, token: string): void {
  keep.setItem(kTokenKey, token);
}

export function keptToken(keep: Keep): string {
  return keep.getItem(kTokenKey) ?? '';
}

/** The token in the fragment of the printed address: "#token=…" or the token alone. */
export function tokenIn(fragment: string): string {
  const text = fragment.replace(/^#/, '');
  return (
    new URLSearchParams(text).get('token') ?? (text.includes('=') ? '' : decodeURIComponent(text))
  );
}
