import '../look/project.css';
import { FileTree } from './tree/file_tree';
import { Outline } from './outline/outline';

/** Files of the project, and what is in the script that is looked at. */
export default function ProjectPanel() {
  return (
    <div className="scroll project">
      <FileTree />
      <Outline />
    </div>
  );
}
