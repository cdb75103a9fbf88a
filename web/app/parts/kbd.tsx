import { keysShown } from './keys_shown';

/** As they are on the keys. */
const arrows: Readonly<Record<string, string>> = {
  ArrowLeft: '←',
  ArrowRight: '→',
  ArrowUp: '↑',
  ArrowDown: '↓',
};

export function Kbd({ keys }: { keys: string }) {
  return (
    <span className="kbd">
      {keysShown(keys).replace(/Arrow\w+/, (name) => arrows[name] ?? name)}
    </span>
  );
}
