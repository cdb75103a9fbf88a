// Words of the settings: apart from text.ts, as they come with their panel.

export const settingsWords = {
  title: 'Settings',
  theme: 'Theme',
  themes: { system: 'System', dark: 'Dark', light: 'Light' },
  codeSize: 'Code font size',
  spaces: 'Indentation',
  spacesOf: (count: number) => `${count} spaces`,
  words: 'Words of bytecode at each handler',
  wrap: 'Wrap long lines',
  keys: 'Keys',
  about: 'About',
  version: 'Version',
  licences: 'Licences of the parts',
  appearance: 'Appearance',
  editor: 'Script editor',
};
