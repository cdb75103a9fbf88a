import type { HelpEntry } from '../../../core/help/entries';
import { piecesOf, type Block } from '../../../core/help/page';
import { helpWords } from './words';

const words = helpWords;

/** What an entry says: how it is written, what it is, an example. */
export function HelpText({ entry }: { entry: HelpEntry }) {
  const { name, kind, node, form, help, section, example } = entry;
  return (
    <div className="help__text" tabIndex={0} role="region" aria-label={name}>
      <h3 className={kind === 'topic' ? '' : 'help__name'}>{name}</h3>
      {kind === 'topic' ? null : <p className="help__what">{words.of(words.kinds[kind], node)}</p>}
      {form ? <pre className="help__code">{form}</pre> : null}
      {help ? (
        <p>
          <Line>{help}</Line>
        </p>
      ) : null}
      {section && kind !== 'topic' ? (
        <h4>
          <Line>{section.title}</Line>
        </h4>
      ) : null}
      {section?.blocks.map((block, index) => (
        <Part key={index} block={block} />
      ))}
      {example ? (
        <>
          <h4>{words.example}</h4>
          <pre className="help__code">{example}</pre>
        </>
      ) : null}
    </div>
  );
}

function Part({ block }: { block: Block }) {
  switch (block.is) {
    case 'text':
      return (
        <p>
          <Line>{block.text}</Line>
        </p>
      );
    case 'code':
      return <pre className="help__code">{block.text}</pre>;
    case 'list':
      return (
        <ul>
          {block.items.map((item) => (
            <li key={item}>
              <Line>{item}</Line>
            </li>
          ))}
        </ul>
      );
    case 'table':
      return (
        <table>
          <tbody>
            {block.rows.map((row) => (
              <tr key={row.join('|')}>
                {row.map((cell, index) => (
                  <td key={index}>
                    <Line>{cell}</Line>
                  </td>
                ))}
              </tr>
            ))}
          </tbody>
        </table>
      );
  }
}

function Line({ children }: { children: string }) {
  return piecesOf(children).map(({ is, text: piece }, index) => {
    if (is === 'code') return <code key={index}>{piece}</code>;
    if (is === 'strong') return <b key={index}>{piece}</b>;
    return is === 'emphasis' ? <em key={index}>{piece}</em> : piece;
  });
}
