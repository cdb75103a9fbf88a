import type { ReactNode } from 'react';

/** Numbers stand at the right edge; a hidden title is only spoken; '': nothing to say. */
export interface Column {
  title: string;
  is?: 'number' | 'hidden';
}

/** A table of the network: how many rows it has, what can be done with them, its columns. */
export function NetworkPart(props: {
  title: string;
  count: number;
  tools?: ReactNode;
  /** Said instead of a table without rows. */
  empty?: string;
  columns: readonly Column[];
  className?: string;
  children: ReactNode;
}) {
  const { title, count, tools, empty, columns, className = 'table', children } = props;
  return (
    <section className="network__part">
      <div className="network__head">
        <h3>{title}</h3>
        <span className="count">{count}</span>
        {tools}
      </div>
      {count === 0 && empty !== undefined ? (
        <p className="quiet">{empty}</p>
      ) : (
        <table className={className}>
          <thead>
            <tr>
              {columns.map((column, index) => (
                <Title key={`${index} ${column.title}`} {...column} />
              ))}
            </tr>
          </thead>
          <tbody>{children}</tbody>
        </table>
      )}
    </section>
  );
}

function Title({ title, is }: Column) {
  if (title === '') return <td />;
  return (
    <th scope="col" className={is === 'number' ? 'table__num' : undefined}>
      {is === 'hidden' ? <span className="hidden-text">{title}</span> : title}
    </th>
  );
}
