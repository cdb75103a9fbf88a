export function Kbd({ keys }: { keys: string }) {
  return <span className="kbd">{keys}</span>;
}
