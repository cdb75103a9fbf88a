// Words of the new token: apart from text.ts, as they come with it.

export const newTokenWords = {
  title: 'New token',
  what: 'Whoever has the token of the printed address may take control. A new one makes the old one void: other pages that used it are disconnected, and must open the new address.',
  make: 'Make a new token',
  made: 'This page has the new token already. Other pages open this address:',
  address: 'New address',
  cancel: 'Cancel',
  close: 'Close',
};
