// Icons by what they mean, so that one thing looks the same everywhere.

import {
  IconCode,
  IconFile,
  IconFileText,
  IconFolder,
  IconFolderOpen,
  IconMap2,
  IconPhoto,
  IconSettings2,
  IconSitemap,
  IconTool,
  type TablerIcon,
} from '@tabler/icons-react';
import type { FileEntry } from '../../protocol/messages';

export const kStroke = 1.75;

const fileIcons: Record<FileEntry['kind'], TablerIcon> = {
  folder: IconFolder,
  script: IconCode,
  plan: IconSitemap,
  world: IconMap2,
  toolbox: IconTool,
  project: IconSettings2,
  picture: IconPhoto,
  text: IconFileText,
  other: IconFile,
};

export function FileIcon({ kind, open = false }: { kind: FileEntry['kind']; open?: boolean }) {
  const Icon = kind === 'folder' && open ? IconFolderOpen : fileIcons[kind];
  return <Icon className="icon" size={14} stroke={kStroke} aria-hidden />;
}

export function Logo() {
  return (
    <svg viewBox="0 0 24 24" aria-hidden="true">
      <rect width="24" height="24" rx="6" fill="var(--accent)" />
      <g
        fill="none"
        stroke="var(--text-on-fill)"
        strokeWidth="2.2"
        strokeLinecap="round"
        strokeLinejoin="round"
      >
        <path d="M6 7l4.2 10h1.6" />
        <path d="M11.8 17C15 17 13.6 9 17.4 9" />
      </g>
      <circle cx="18" cy="9" r="2" fill="var(--text-on-fill)" />
    </svg>
  );
}
