import { text } from '../text';
import { ConnectBox } from './connect_box';
import { Examples } from './examples';
import { FolderBox } from './folder_box';
import { RecentBox } from './recent_box';
import '../look/start.css';
import { startWords } from './words';

/** The first screen: an example, a robot, a folder. */
export default function StartScreen() {
  return (
    <main className="first" data-region="start">
      <div className="first__in">
        <div className="first__head">
          <h1>{text.start.title}</h1>
          <p>{startWords.help}</p>
        </div>
        <Examples />
        <aside>
          <ConnectBox />
          <FolderBox />
          <RecentBox />
        </aside>
      </div>
    </main>
  );
}
